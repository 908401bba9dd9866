// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A double-pointed wire that came out of the skin beyond the bone can be held there, and be drawn
// through until its near end lies in the bone, then back again [clinical: B1 step 5].
#include "geometry/trilinear.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

constexpr double kGraspMm = 8.0;        // of a wire out of the skin, for a driver's jaws [E]
constexpr double kAirHu = -300.0;       // halfway from air to tissue, with room for a blurred skin
constexpr double kOutsideHu = -1000.0;  // beyond the scan
constexpr double kFlushMm = 1.0;        // standing out no more than cartilage is thick [E]
constexpr double kDrawMmPerS = 12.0;    // of a wire in its own hole, either way [E]
constexpr double kLooseThrustN = 10.0;  // push at which it goes so fast

}  // namespace

/// Whether the point of its line is out of the skin, told by the CT, with the tissue as the bone
/// nearest to it carries it.
bool World::State::is_in_air(const Model& model,
                             const Item& item,
                             double travel_mm) const noexcept {
  const Vec3 in_bone = item.origin_in_bone + item.direction_in_bone * travel_mm;
  const Vec3 point = (poses[item.body] * Point<frame::Bone>{in_bone}).v;
  return is_air_at(model, point, in_bone);
}

/// @param far  where the point is in the CT when no bone is near that could carry the tissue.
bool World::State::is_air_at(const Model& model,
                             const Vec3& point,
                             const Vec3& far) const noexcept {
  const Touched nearest = surface_at(point);
  const Vec3 scanned =
      nearest.body == kNoBody ? far : (inverses[nearest.body] * Point<frame::Patient>{point}).v;
  return sample_at(model.data.ct.view(), scanned, kOutsideHu) < kAirHu;
}

/// Whether a free wire's shaft is out of the skin from so far behind its tip on: whoever holds it
/// there is no part of the forearm. Scripted ways to either pole left the skin within 30 mm
/// (docs/scoring.md).
bool World::State::is_shaft_out(const Model& model, const Item& item) const noexcept {
  constexpr double kUnderSkinMm = 45.0;
  constexpr double kStepMm = 10.0;
  for (double back = kUnderSkinMm; back < item.length_mm; back += kStepMm) {
    const Vec3 point = item.tip + item.shaft * back;
    if (!is_air_at(model, point, point)) return false;
  }
  return true;
}

bool World::State::is_near_end_out(const Model& model, const Item& item) const noexcept {
  return !item.is_broken && item.length_mm - item.depth_mm() > kGraspMm &&
         is_in_air(model, item, item.travel_mm - item.length_mm + kGraspMm);
}

bool World::State::is_far_end_out(const Model& model, const Item& item) const noexcept {
  return item.in_target && item.depth_mm() - item.chord_mm > kGraspMm &&
         is_in_air(model, item, item.travel_mm - kGraspMm);
}

void World::State::pick_up_far_end(const Model& model,
                                   std::uint8_t hand,
                                   std::uint8_t item) noexcept {
  pick_up(model, hand, item);
  now.items[item].by_far_end = true;
}

/// Forward pushes it back to where it came from, reverse draws it on through the bone.
void World::State::draw_by_far_end(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  const detail::HandState& held = spent.hands[hand];
  if (held.wish.driver == Driver::Forward) {
    const double share =
        held.wish.thrust_n < kLooseThrustN ? held.wish.thrust_n / kLooseThrustN : 1.0;
    const double back = item.travel_mm - share * kDrawMmPerS * kTickSeconds;
    // The driver's jaws stop at the skin.
    if (is_in_air(model, item, back - kGraspMm)) item.travel_mm = back;
  } else if (held.wish.driver == Driver::Reverse && !held.reverse_is_held) {
    item.travel_mm += kDrawMmPerS * kTickSeconds;
    if (item.depth_mm() - item.length_mm >= item.chord_mm) {
      return come_out_at_far_side(model, hand);
    }
  }
  if (item.length_mm - item.depth_mm() <= kFlushMm) item.was_flush = true;
  cut(model, item);
  note_tip(model, now.held[hand]);
  carry_fixed_items();
}

/// Drawn all the way through: it is free in the hand, which now has the other point foremost.
void World::State::come_out_at_far_side(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  carry_fixed_items();
  const Vec3 other_end = item.tip + item.shaft * item.length_mm;
  const InstrumentIndex instrument = item.instrument;
  const double length_mm = item.length_mm;
  const Vec3 shaft = -item.shaft;
  emit(EventKind::Withdrawn, now.held[hand], instrument, 0.0);
  item = Item{};
  item.instrument = instrument;
  item.hand = hand;
  item.length_mm = length_mm;
  item.tip = other_end;
  item.shaft = shaft;
  spent.hands[hand].reverse_is_held = true;
  spent.hands[hand].touched_body = kNoBody;
  if (!has_screw_in_target(model)) now.gauge_reading_mm = -1.0;
  scene.forget();
}

}  // namespace carpus::simulation
