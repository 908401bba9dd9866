// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A headless screw's thread is coarser at its tip than at its tail: with each turn the pieces that
// it holds come nearer, then press on each other, until the thread gives way [clinical: B3, S49].
#include <algorithm>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::bit_of;
using detail::Displacement;
using detail::InBone;
using detail::Item;

namespace {

constexpr double kEngagedMm = 3.0;  // of thread in the far piece, two turns: then it pulls [E]
constexpr double kTailEngagedMm =
    4.0;                          // of a whole bone's near cortex, before the tail is level [E]
constexpr double kNPerMm = 30.0;  // of pieces that touch: 74 N when buried by 2 mm, where
                                  // cadavers kept 69 +- 36 [S49; E]
constexpr double kPeakN = 120.0;  // in whole bone: cadavers' peak was 104 +- 33 [S49]
constexpr double kStrippedShare = 0.3;  // of its hold that is left [E]

}  // namespace

/// The pieces' way towards each other, in this advance of the screw; what is left once they touch.
double World::State::close_gap(const Model& model, Item& screw, double closing_mm) noexcept {
  const auto& [first, second, faces] = *model.fracture;
  const std::uint8_t far = screw.body == first ? second : first;
  const Vec3 along = (poses[screw.body] * Direction<frame::Bone>{screw.direction_in_bone}).v;
  const Vec3 in_base = (bases[far].inverse() * Direction<frame::Patient>{along}).v;
  const Displacement before = now.moved[far];
  displace_fragment(model, far, InBone{Mat3::identity(), in_base * -closing_mm},
                    model.kinds.fragments);
  if (now.moved[far] == before) return closing_mm;
  pose_bodies(model);
  for (Item& item : now.items) {
    if (item.is_there() && item.is_fixed() && item.in_target && item.body == screw.body) {
      item.chord_mm = std::max(0.0, item.chord_mm - closing_mm);
    }
  }
  return 0.0;
}

void World::State::compress(const Model& model, std::uint8_t index, double advanced_mm) noexcept {
  Item& screw = now.items[index];
  const double closing_mm = kind_of(model, screw).closing_share * advanced_mm;
  if (now.is_stripped || !screw.in_target || closing_mm == 0.0) return;
  if (closing_mm < 0.0) {
    now.closure_mm = std::max(0.0, now.closure_mm + closing_mm);
  } else if (model.fracture) {
    const detail::BodySet pieces = bit_of(model.fracture->first) | bit_of(model.fracture->second);
    for (std::size_t i = 0; i < screw.crossing_count; ++i) {
      const auto& [body, at_mm] = screw.crossings[i];
      const bool is_far = body != screw.body && (pieces & bit_of(body)) != 0;
      if (!is_far || screw.travel_mm - at_mm < kEngagedMm) continue;
      now.closure_mm += close_gap(model, screw, closing_mm);
      break;
    }
  } else if (buried_mm(model, screw) > -kTailEngagedMm) {
    now.closure_mm += closing_mm;
  }
  now.compression_n = kNPerMm * now.closure_mm;
  if (now.compression_n <= kPeakN * now.holding_share) return;
  now.is_stripped = true;
  ++spent.stripped_screws;
  now.compression_n = 0.0;
  now.holding_share *= kStrippedShare;
  emit(EventKind::ScrewStripped, index, 0, 0.0);
}

}  // namespace carpus::simulation
