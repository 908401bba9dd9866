// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A wire through two bones makes one body of them. Where the other bone belongs to the hand, the
// one that is operated on goes along with it; where it belongs to the forearm, or there are more,
// the wrist is held.
#include <cstdint>

#include "anatomy/bone_id.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::bit_of;
using detail::Displacement;
using detail::Item;

namespace {

constexpr double kEasedPerTick = 0.004;  // let go of, it goes back to its place in a quarter second
constexpr double kThereMm = 1e-3;
constexpr double kThereTurn = 1e-5;
constexpr double kDeeperMm = 0.3;  // into a neighbour, as cartilage gives way [E]

}  // namespace

/// Bones that instruments tie to the target, all in one set; also those tied to each other.
detail::BodySet World::State::bones_pinned(const Model& model) const noexcept {
  detail::BodySet pinned = 0;
  for (const Item& item : now.items) {
    if (!item.is_there() || !item.is_fixed()) continue;
    detail::BodySet entered = 0;
    for (std::size_t i = 0; i < item.crossing_count; ++i) {
      entered |= bit_of(item.crossings[i].body);
    }
    const detail::BodySet others = entered & ~model.kinds.target;
    const bool is_tied =
        (entered & model.kinds.target) != 0 ? others != 0 : (others & (others - 1U)) != 0;
    if (is_tied) pinned |= entered;
  }
  return pinned;
}

/// What moves along with the target, kNoBody where nothing does, or the wrist is held.
std::uint8_t World::State::carrier(const Model& model) const noexcept {
  const detail::BodySet pinned = bones_pinned(model);
  const detail::BodySet others = pinned & ~model.kinds.target;
  const bool is_one = others != 0 && (others & (others - 1U)) == 0;
  if (!is_one || (pinned & model.kinds.target) == 0) return kNoBody;
  const std::uint8_t body = detail::first_of(others);
  return belongs_to_forearm(model.data.bones[body].bone) ? kNoBody : body;
}

bool World::State::is_wrist_pinned(const Model& model) const noexcept {
  return bones_pinned(model) != 0 && carrier(model) == kNoBody;
}

/// Whether the target, carried along, has come into a neighbour.
bool World::State::is_target_inside_another(const Model& model) const noexcept {
  const std::uint8_t with = carrier(model);
  for (std::uint8_t t = 0; t < snapshot.body_count; ++t) {
    if ((model.kinds.target & bit_of(t)) == 0) continue;
    for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
      if (b == with || (model.kinds.target & bit_of(b)) != 0) continue;
      for (const Vec3& corner : model.data.bones[t].hull.vertices) {
        const Vec3 local = (inverses[b] * (poses[t] * Point<frame::Bone>{corner})).v;
        if (tissue.is_near(b, local) && tissue.untouched_distance_mm(b, local) < -kDeeperMm) {
          return true;
        }
      }
    }
  }
  return false;
}

/// The wrist has moved and the target's own motion with it: it stays by what it is pinned to.
/// @param with_from_target  pose of the target as the carrier sees it, before.
void World::State::carry_target(const Model& model,
                                std::uint8_t with,
                                const detail::InBone& with_from_target) noexcept {
  const std::uint8_t first = detail::first_of(model.kinds.target);
  const auto own =
      model.data.hand_motion.poses_at(spent.wrist)[static_cast<std::size_t>(model.groups[first])];
  now.carried = Displacement::of(own.inverse() * (poses[with] * with_from_target));
  pose_bodies(model);
}

/// No longer pinned, it goes back to where the wrist's motion takes it.
void World::State::ease_carried(const Model& model) noexcept {
  if (now.carried.is_none() || carrier(model) != kNoBody) return;
  now.carried = now.carried.eased(kEasedPerTick);
  if (squared_length(now.carried.turn) < kThereTurn * kThereTurn &&
      squared_length(now.carried.shift) < kThereMm * kThereMm) {
    now.carried = {};
  }
  pose_bodies(model);
  carry_fixed_items();
}

}  // namespace carpus::simulation
