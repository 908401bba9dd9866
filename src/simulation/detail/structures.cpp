// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Harm to what lies under the skin: something that turns, and what of it is bare.
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

/// A sleeve of the other hand leads an item while their shafts are one to rounding.
constexpr double kLedMm = 1e-9;

}  // namespace

/// Which items a sleeve leads, or led when they went into bone: what a sleeve stood in is spread
/// aside, for the wire and for what rides on it.
void World::State::note_sleeves(const Model& model) noexcept {
  for (std::uint8_t i = 0; i < kMaxItems; ++i) {
    const Item& item = now.items[i];
    bool& is_led = structure_state.is_led[i];
    if (!item.is_there()) {
      is_led = false;
    } else if (item.wire < kMaxItems) {
      is_led = structure_state.is_led[item.wire];
    } else if (!item.is_fixed()) {
      is_led = false;
      if (item.hand >= kHands) continue;
      const Item* sleeve = in_hand(1U - item.hand);
      is_led = sleeve != nullptr && kind_of(model, *sleeve).is_sleeve &&
               distance(item.shaft, sleeve->shaft) <= kLedMm;
    }
  }
}

/// What of a turning item is bare of bone and sleeve, as a segment: of one that was led only what
/// is beyond where it went into bone, or out of its sleeve.
World::State::Bare World::State::bare_part(std::uint8_t index) const noexcept {
  const Item& item = now.items[index];
  const Vec3 back = item.tip + item.shaft * item.length_mm;
  if (!structure_state.is_led[index]) return {item.tip, back};
  if (item.is_fixed()) {
    return {item.tip, (poses[item.body] * Point<frame::Bone>{item.origin_in_bone}).v};
  }
  const std::uint8_t sleeve = now.held[1U - item.hand];
  const Vec3 mouth = sleeve < kMaxItems ? now.items[sleeve].tip : item.tip;
  const bool is_out = dot(item.tip - mouth, item.shaft) < 0.0;
  return {item.tip, is_out ? mouth : item.tip};
}

void World::State::watch_structures(const Model& model) noexcept {
  if (structures.size() == 0) return;
  note_sleeves(model);
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const Item* item = in_hand(h);
    if (item == nullptr || spent.hands[h].wish.driver == Driver::Off) continue;
    const instruments::Instrument& kind = kind_of(model, *item);
    if (kind.work == instruments::Work::None) continue;
    structures.follow({poses.data(), snapshot.body_count});
    const Bare bare = bare_part(now.held[h]);
    // What rides on a wire takes its way, held open: it harms what the wire's way leads through.
    const instruments::Instrument& opens =
        item->wire < kMaxItems ? kind_of(model, now.items[item->wire]) : kind;
    const double radius = opens.cut_tip_radius_mm;
    for (std::size_t i = 0; i < structures.size(); ++i) {
      detail::StructureHarm& harm = structure_state.harm[i];
      // Only what is nearer than ever before changes anything; what is struck is below 0 already.
      const double gap = structures.gap_mm(i, bare.from, bare.to, harm.least_mm + radius) - radius;
      if (gap < harm.least_mm) {
        harm.least_mm = gap;
        harm.by = item->instrument;
      }
      if (gap < 0.0 && !harm.was_struck) {
        harm.was_struck = true;
        emit(EventKind::StructureStruck, now.held[h], static_cast<std::int32_t>(i), gap);
      }
    }
  }
}

}  // namespace carpus::simulation
