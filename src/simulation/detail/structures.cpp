// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Harm to what lies under the skin: something that turns, and what of it is bare; and what goes
// through a portal, on its way from the skin to the capsule.
#include <algorithm>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

/// A sleeve of the other hand leads an item while their shafts are one to rounding.
constexpr double kLedMm = 1e-9;
constexpr double kPointMm = 1.5;    // of a wire, over which it comes to its width
constexpr double kOffMarkMm = 1.0;  // of the marked way: a hand so near has kept to it [E]

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
      // Drawn back out of bone it stands in the way that was spread for it until it is let turn
      // again.
      const bool came_out = item.hand < kHands && spent.hands[item.hand].reverse_is_held;
      is_led = is_led && came_out;
      if (is_led) continue;
      if (item.hand >= kHands) continue;
      const Item* sleeve = in_hand(1U - item.hand);
      is_led = sleeve != nullptr && kind_of(model, *sleeve).is_sleeve &&
               distance(item.shaft, sleeve->shaft) <= kLedMm;
    }
  }
}

/// What of a turning item is bare of bone and sleeve. In the bone that it came through nothing lies
/// but bone, whatever the generated tubes say; of one that was led only what is out at the far side
/// is bare, or out of its sleeve.
World::State::BareParts World::State::bare_parts(std::uint8_t index,
                                                 double radius_mm) const noexcept {
  BareParts bare;
  const auto add = [&bare](const Vec3& from, const Vec3& to, double radius) {
    bare.part[bare.count++] = {from, to, radius};
  };
  const Item& item = now.items[index];
  const Vec3 back = item.tip + item.shaft * item.length_mm;
  const bool is_led = structure_state.is_led[index];
  if (!item.is_fixed()) {
    if (!is_led) {
      add(item.tip, back, radius_mm);
      return bare;
    }
    const std::uint8_t sleeve = now.held[1U - item.hand];
    const Vec3 mouth = sleeve < kMaxItems ? now.items[sleeve].tip : item.tip;
    const bool is_out = dot(item.tip - mouth, item.shaft) < 0.0;
    if (is_out) add(item.tip, mouth, radius_mm);
    return bare;
  }
  const auto at = [&](double travel_mm) {
    return (poses[item.body] *
            Point<frame::Bone>{item.origin_in_bone + item.direction_in_bone * travel_mm})
        .v;
  };
  if (!is_led && item.travel_mm < item.length_mm) add(at(0.0), back, radius_mm);
  const double exit_mm = item.in_target ? item.entry_at_mm + item.chord_mm : 0.0;
  const double out_mm = item.travel_mm - exit_mm;
  if (out_mm > 0.0) {
    const double share = out_mm < kPointMm ? out_mm / kPointMm : 1.0;
    add(item.tip, at(exit_mm), radius_mm * share);
  }
  return bare;
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
    // What rides on a wire takes its way, held open: it harms what the wire's way leads through.
    const instruments::Instrument& opens =
        item->wire < kMaxItems ? kind_of(model, now.items[item->wire]) : kind;
    const BareParts bare = bare_parts(now.held[h], opens.cut_tip_radius_mm);
    for (std::size_t i = 0; i < structures.size(); ++i) {
      // Only what is nearer than ever before changes anything; what is struck is below 0 already.
      double gap = structure_state.harm[i].least_mm;
      for (std::size_t p = 0; p < bare.count; ++p) {
        const auto& [from, to, radius] = bare.part[p];
        gap = std::min(gap, structures.gap_mm(i, from, to, gap + radius) - radius);
      }
      note_harm(h, i, gap, gap < 0.0);
    }
  }
}

void World::State::note_harm(std::uint8_t hand,
                             std::size_t structure,
                             double gap_mm,
                             bool is_struck) noexcept {
  detail::StructureHarm& harm = structure_state.harm[structure];
  const bool strikes = is_struck && !harm.was_struck;
  // What came nearest, until something strikes it: then that, whatever goes by afterwards.
  if (strikes || (gap_mm < harm.least_mm && !harm.was_struck)) {
    harm.by = now.items[now.held[hand]].instrument;
  }
  harm.least_mm = std::min(harm.least_mm, gap_mm);
  if (!strikes) return;
  harm.was_struck = true;
  emit(EventKind::StructureStruck, now.held[hand], static_cast<std::int32_t>(structure), gap_mm);
}

/// At the moment that it enters the joint: what its shaft lies beside from there to the hole in the
/// skin. Nerves and arteries are struck by a touch; tendons are spread aside, so that only a way
/// through the middle of one harms it [E], and not the marked way itself, where no other was left.
void World::State::note_way_in(const Model& model, std::uint8_t hand, const Item& item) noexcept {
  // A way that was made was judged as it was made.
  if (structures.size() == 0 || model.goes_in_by_own()) return;
  structures.follow({poses.data(), snapshot.body_count});
  const std::uint8_t portal = scope_state.portal[hand];
  const WayIn marked = marked_way(model, portal);
  const Vec3 capsule = marked.skin + marked.inwards * marked.capsule_mm;
  const Vec3 back = item.tip + item.shaft * distance(item.tip, marked.skin);
  const double radius_mm = kind_of(model, item).shape.greatest_radius_mm();
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const double gap = structures.gap_mm(i, item.tip, back) - radius_mm;
    const bool is_spread = structures.kind(i) == anatomy::StructureKind::Tendon;
    double least = is_spread ? -structures.radius_mm(i) : 0.0;
    if (is_spread) {
      least = std::min(least, structures.gap_mm(i, capsule, marked.skin) - radius_mm - kOffMarkMm);
    }
    note_harm(hand, i, gap, gap < least);
  }
}

}  // namespace carpus::simulation
