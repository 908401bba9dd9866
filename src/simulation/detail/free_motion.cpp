// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A free instrument: followed to where the hand wants it, pushed out of bone by the contact of its
// whole shape with the bones' true surfaces, resting, skating, and what makes it bite.
#include <algorithm>
#include <cstdint>

#include "instruments/drilling_resistance.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::Item;

namespace {

constexpr double kSubstepMm = 0.25;      // below half a wire's diameter: no tunnelling
constexpr int kMaxSubsteps = 8;          // 2 mm a tick is 2 m/s; a farther target is chased
constexpr int kMaxPushes = 6;            // a wedge between two bones settles in three or four
constexpr double kToleranceMm = 1e-4;    // penetration left alone: a tenth of a micrometre
constexpr double kFarthestPushMm = 1.0;  // beyond it the way back is not sought here
constexpr double kTurnPerTick = 0.01;    // rad: 0.8 mm at the far end of a wire
constexpr double kTouchingMm = 0.05;     // tip this near the surface counts as resting on it
constexpr double kEngageThrustN = 1.0;   // less is a touch
constexpr double kSleeveReachMm = 3.0;   // a tip this near a sleeve's axis slips into it

Pose<frame::Patient, frame::Tool> tool_pose(const Vec3& tip, const Vec3& shaft) noexcept {
  const Vec3 x = any_perpendicular(shaft);
  return {Mat3::from_columns(x, cross(shaft, x), shaft), tip};
}

}  // namespace

/// Brings the contacts of what a hand holds up to this pose.
void World::State::look(std::uint8_t hand, const Vec3& tip, const Vec3& shaft) noexcept {
  scene.update_instrument(hand, tool_pose(tip, shaft), inverses);
}

/// Pushes the instrument, without turning it, out of every bone that it penetrates, and its tip out
/// of what else does not yield to it.
World::State::Resolved World::State::push_out(const Model& model,
                                              std::uint8_t hand,
                                              Vec3 tip,
                                              const Vec3& shaft) noexcept {
  Resolved result{tip, true, false};
  for (int push = 0; push < kMaxPushes; ++push) {
    look(hand, tip, shaft);
    double deepest_mm = kToleranceMm;
    Vec3 normal;
    for (const contact::InstrumentBonePair& pair : scene.alerts(hand)) {
      const contact::SurfaceContact& contact = scene.contact(hand, pair.bone);
      if (!contact.has_contact() || !(-contact.gap_mm > deepest_mm)) continue;
      if (!(squared_length(contact.normal.v) > 0.0)) continue;
      deepest_mm = -contact.gap_mm;
      normal = (poses[pair.bone] * contact.normal).v;
    }
    if (const Wall wall = wall_at(model, hand, tip); wall.depth_mm > deepest_mm) {
      deepest_mm = wall.depth_mm;
      normal = wall.out;
    }
    if (const Wall metal = metal_at(model, hand, tip, shaft); metal.depth_mm > deepest_mm) {
      deepest_mm = metal.depth_mm;
      normal = metal.out;
    }
    if (!(deepest_mm > kToleranceMm)) {
      result.tip = tip;
      return result;
    }
    result.is_free = false;
    tip += normal * deepest_mm;
    if (distance(tip, result.tip) > kFarthestPushMm) break;
  }
  result.is_wedged = true;
  return result;
}

World::State::Touched World::State::surface_at(const Vec3& point) const noexcept {
  Touched nearest;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    const Vec3 local = (inverses[b] * Point<frame::Patient>{point}).v;
    if (!tissue.is_near(b, local)) continue;
    const double distance_mm = tissue.untouched_distance_mm(b, local);
    if (nearest.body != kNoBody && distance_mm >= nearest.distance_mm) continue;
    const Vec3 normal = tissue.untouched_normal(b, local);
    nearest = {b, distance_mm, (poses[b] * Direction<frame::Bone>{normal}).v};
  }
  return nearest;
}

void World::State::turn_towards(Item& item, const Vec3& shaft) noexcept {
  const Vec3 difference = shaft - item.shaft;
  const double far = length(difference);
  if (!(far > 0.0)) return;
  const Vec3 next = far > kTurnPerTick ? item.shaft + difference * (kTurnPerTick / far) : shaft;
  // Opposite directions have no way between them: leave by any perpendicular.
  item.shaft = normalized_or(next, any_perpendicular(item.shaft));
}

void World::State::move_free(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  if (lead_through_sleeve(model, hand)) return rest_or_engage(model, hand);
  const Vec3 before = item.shaft;
  turn_towards(item, led_by_portal(model, hand, item.tip, spent.hands[hand].plan.shaft));
  // Bones may have moved into it, or it turned into them.
  Resolved turned = push_out(model, hand, item.tip, item.shaft);
  if (turned.is_wedged) {  // no room to turn
    ++faults.unresolved_contacts;
    item.shaft = before;
    turned = push_out(model, hand, item.tip, item.shaft);
  }
  if (turned.is_wedged) {  // between bones that close on it: it holds them
    stop_wrist(model);
  } else {
    item.tip = turned.tip;
  }
  chase(model, hand, spent.hands[hand].plan.tip);
  rest_or_engage(model, hand);
}

/// Moves the tip towards the target in steps too short to pass through anything, pushing the
/// instrument out of bone after each: so it slides along surfaces.
void World::State::chase(const Model& model, std::uint8_t hand, const Vec3& target) noexcept {
  constexpr double kArrivedMm = 1e-9;
  constexpr double kNoProgressMm = 1e-4;
  Item& item = *in_hand(hand);
  const detail::HandState& held = spent.hands[hand];
  for (int i = 0; i < kMaxSubsteps; ++i) {
    const Vec3 wanted = target - item.tip;
    const double far = length(wanted);
    const Vec3 next = far > kSubstepMm ? item.tip + wanted * (kSubstepMm / far) : target;
    Resolved resolved = push_out(model, hand, next, item.shaft);
    if (resolved.is_wedged && scope_state.portal[hand] != detail::kNoPortal) {
      // Held fast between two bones, it still goes back along its shaft, the way that it came.
      const double back = dot(next - item.tip, item.shaft);
      const Vec3 out = item.tip + item.shaft * back;
      if (back > 0) resolved = push_out(model, hand, out, item.shaft);
      // Where pushing settles nothing it slides out as it lies, as long as that goes no deeper into
      // anything: else it would stay for ever, however far the hand is drawn back.
      const auto depth_at = [&](const Vec3& tip) {
        look(hand, tip, item.shaft);
        double deepest_mm = std::max(wall_at(model, hand, tip).depth_mm,
                                     metal_at(model, hand, tip, item.shaft).depth_mm);
        for (const contact::InstrumentBonePair& pair : scene.alerts(hand)) {
          const contact::SurfaceContact& contact = scene.contact(hand, pair.bone);
          if (contact.has_contact()) deepest_mm = std::max(deepest_mm, -contact.gap_mm);
        }
        return deepest_mm;
      };
      if (back > 0 && resolved.is_wedged && depth_at(out) <= depth_at(item.tip) + kToleranceMm) {
        resolved = {out, false, false};
      }
    }
    if (resolved.is_wedged) {
      ++faults.unresolved_contacts;
      const bool is_stuck = i == 0 && scope_state.portal[hand] != detail::kNoPortal;
      if (is_stuck) spent.hands[hand].coupling.hold_fast(item.tip, target);
      return;
    }
    // A tip that the spinning driver does not turn bites: it stays while the pull along the surface
    // is within the friction cone about the last contact.
    if (!resolved.is_free && held.touched_body != kNoBody && !held.forward_is_held) {
      const double pressed = -dot(target - item.tip, held.contact_normal);
      const Vec3 along = target - item.tip + held.contact_normal * pressed;
      if (pressed > 0 && length(along) <= instruments::kTipFriction * pressed &&
          push_out(model, hand, item.tip, item.shaft).is_free) {
        return;
      }
    }
    const double moved = distance(resolved.tip, item.tip);
    const double nearer = far - distance(resolved.tip, target);
    item.tip = resolved.tip;
    if (far <= kArrivedMm || moved < kNoProgressMm || nearer < kNoProgressMm) return;
  }
}

/// A wire whose tip is in a sleeve that the other hand holds runs along the sleeve's axis.
bool World::State::lead_through_sleeve(const Model& model, std::uint8_t hand) noexcept {
  const Item& sleeve_item = [&]() -> const Item& {
    static constexpr Item kNothing{};
    const Item* other = in_hand(1U - hand);
    return other != nullptr ? *other : kNothing;
  }();
  if (!sleeve_item.is_there()) return false;
  const instruments::Instrument& sleeve = kind_of(model, sleeve_item);
  Item& item = *in_hand(hand);
  const instruments::Instrument& wire = kind_of(model, item);
  if (!sleeve.is_sleeve || wire.work != instruments::Work::Drill ||
      wire.shape.greatest_radius_mm() > sleeve.bore_radius_mm) {
    return false;
  }
  const Vec3 wanted = spent.hands[hand].plan.tip;
  const double along = dot(wanted - sleeve_item.tip, sleeve_item.shaft);
  const Vec3 on_axis = sleeve_item.tip + sleeve_item.shaft * along;
  // Beyond the sleeve's far end it is out; before its mouth it runs on as it was led.
  if (along > sleeve.length_mm || distance(wanted, on_axis) > kSleeveReachMm) return false;
  const Vec3 shaft_before = item.shaft;
  item.shaft = sleeve_item.shaft;
  const double from = std::clamp(dot(item.tip - sleeve_item.tip, sleeve_item.shaft), -100.0, 200.0);
  const double way =
      std::clamp(along - from, -kSubstepMm * kMaxSubsteps, kSubstepMm * kMaxSubsteps);
  // Along the axis in short steps, until bone stops it.
  Vec3 tip = sleeve_item.tip + sleeve_item.shaft * from;
  const int steps = 1 + static_cast<int>(detail::absolute(way) / kSubstepMm);
  for (int i = 0; i < steps; ++i) {
    const Vec3 next = tip + sleeve_item.shaft * (way / steps);
    look(hand, next, item.shaft);
    bool is_stopped = false;
    for (const contact::InstrumentBonePair& pair : scene.alerts(hand)) {
      is_stopped = is_stopped || scene.contact(hand, pair.bone).gap_mm < -kTouchingMm;
    }
    if (is_stopped && way < 0) break;
    tip = next;
  }
  if (!(distance(tip, tip) == 0.0)) {
    item.shaft = shaft_before;
    return false;
  }
  item.tip = tip;
  return true;
}

void World::State::rest_or_engage(const Model& model, std::uint8_t hand) noexcept {
  Item& item = *in_hand(hand);
  detail::HandState& held = spent.hands[hand];
  const instruments::Instrument& kind = kind_of(model, item);
  // The foremost ball decides what is touched: a cone's tip is the tip itself.
  const double tip_radius = kind.shape.least_radius_mm();
  const Vec3 front = item.tip + item.shaft * kind.shape.front_z_mm();
  Touched surface = surface_at(front);
  snapshot.hands[hand].ahead = surface_ahead(front, tip_radius, surface);
  surface.distance_mm -= tip_radius;
  const bool is_touching = surface.body != kNoBody && surface.distance_mm <= kTouchingMm;
  const std::uint8_t body = is_touching ? surface.body : kNoBody;
  if (body != kNoBody && body != held.touched_body) {
    emit(EventKind::TouchedBone, now.held[hand], body, 0.0);
  }
  held.touched_body = body;
  held.contact_normal = is_touching ? surface.normal_in_patient : Vec3{};
  if (!is_touching || kind.work != instruments::Work::Drill) return;
  if (held.wish.driver != Driver::Forward || held.wish.thrust_n < kEngageThrustN) return;
  const double steepness = dot(item.shaft, surface.normal_in_patient);
  const Item* other = in_hand(1U - hand);
  const bool is_led = other != nullptr && kind_of(model, *other).is_sleeve &&
                      distance(item.shaft, other->shaft) == 0.0;
  if (steepness >= instruments::kSkatingCosine || (is_led && steepness > 0.0)) {
    if (is_shaft_out(model, item)) return engage(model, hand, surface);
    if (!held.slip_is_told) emit(EventKind::ShaftUnderSkin, now.held[hand], body, 0.0);
    held.slip_is_told = true;
    return;
  }
  // Too flat: the tip walks along the surface, the way it is pushed.
  const Vec3 along = surface.normal_in_patient * steepness - item.shaft;
  item.tip += normalized_or(along, {}) * (instruments::kSkatingMmPerS * kTickSeconds);
  if (!held.slip_is_told) emit(EventKind::Slipped, now.held[hand], body, 0.0);
  held.slip_is_told = true;
}

}  // namespace carpus::simulation
