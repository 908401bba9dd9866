// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A wire that stands out of bone is bent by whatever bone comes against it while the wrist moves:
// elastically at first, then for good, at last it breaks [clinical: B1 step 5, S37].
#include <algorithm>
#include <cstdint>

#include "core/units.hpp"
#include "simulation/detail/wire_bend.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::bit_of;
using detail::Item;

namespace {

constexpr double kStepMm = 2.0;    // between the points that are looked at: under any bone's width
constexpr double kReachMm = 60.0;  // farther from the bone it is outside the limb

}  // namespace

/// Where bone first comes against what stands out where the wire went in. Beyond the far cortex
/// lies soft tissue only, or it is held by the bone that it went through.
void World::State::note_press(const Model& model, Item& item) const noexcept {
  const double radius = kind_of(model, item).shape.greatest_radius_mm();
  detail::BodySet entered = model.kinds.target;
  for (std::size_t i = 0; i < item.crossing_count; ++i) entered |= bit_of(item.crossings[i].body);
  const double first_at = item.first_bone_at_mm();
  const double out = std::min(kReachMm, item.length_mm - (item.travel_mm - first_at));
  double deepest = 0.0;
  for (double lever = 2 * kStepMm; lever <= out; lever += kStepMm) {
    const Vec3 in_bone = item.origin_in_bone + item.direction_in_bone * (first_at - lever);
    const Vec3 point = (poses[item.body] * Point<frame::Bone>{in_bone}).v;
    for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
      if ((entered & bit_of(b)) != 0) continue;
      const Vec3 local = (inverses[b] * Point<frame::Patient>{point}).v;
      if (!tissue.is_near(b, local)) continue;
      const double aside_mm = radius - tissue.untouched_distance_mm(b, local);
      if (!(aside_mm > deepest)) continue;
      const Vec3 normal = tissue.untouched_normal(b, local);
      if (!(squared_length(normal) > 0.0)) continue;
      deepest = aside_mm;
      item.press = {b, lever, local + normal * aside_mm, normal};
    }
  }
}

/// The place of that bone stays against the wire, however far the wrist goes on.
void World::State::bend_wire(const Model& model, std::uint8_t index) noexcept {
  Item& item = now.items[index];
  if (item.press.body == kNoBody) note_press(model, item);
  const detail::Press& press = item.press;
  if (press.body == kNoBody) return;
  const detail::BodyPose& pose = poses[press.body];
  const Vec3 at = (pose * Point<frame::Bone>{press.point_in_bone}).v;
  const Vec3 normal = (pose * Direction<frame::Bone>{press.normal_in_bone}).v;
  const double on_line = item.first_bone_at_mm() - press.lever_mm;
  const Vec3 straight = (poses[item.body] *
                         Point<frame::Bone>{item.origin_in_bone + item.direction_in_bone * on_line})
                            .v;
  const double aside_mm = dot(at - straight, normal);
  if (aside_mm <= 0.0) {  // it has left
    item.press = {};
    return;
  }
  const double radius = kind_of(model, item).shape.greatest_radius_mm();
  const double bend = detail::lasting_bend_rad(aside_mm, press.lever_mm, radius);
  if (!(bend > item.bend_rad)) return;
  const Vec3 in_bone = (inverses[item.body] * Direction<frame::Patient>{normal}).v;
  const Vec3 across = in_bone - item.direction_in_bone * dot(in_bone, item.direction_in_bone);
  if (!(squared_length(across) > 0.0)) return;
  if (item.bend_rad == 0.0) {
    emit(EventKind::WireBent, index, press.body, degrees_from_radians(bend));
  }
  item.bend_rad = bend;
  item.bend_in_bone = normalized_or(across, any_perpendicular(item.direction_in_bone));
  spent.most_bend_rad = std::max(spent.most_bend_rad, bend);
  if (bend > detail::kBreakingRad) break_wire(model, index, press.body);
}

void World::State::break_wire(const Model& model, std::uint8_t index, std::uint8_t body) noexcept {
  Item& item = now.items[index];
  item.length_mm = item.travel_mm - item.first_bone_at_mm();
  item.is_broken = true;
  item.bend_rad = 0.0;
  item.bend_in_bone = {};
  item.press = {};
  ++spent.broken_wires;
  emit(EventKind::WireBroke, index, body, 0.0);
  // What ran over the piece that is gone, and the hand that held it.
  for (std::uint8_t i = 0; i < kMaxItems; ++i) {
    if (now.items[i].is_there() && now.items[i].wire == index) let_go_of(model, i);
  }
  if (item.hand != kNoHand && !item.by_far_end) let_go_of(model, index);
}

/// A hand loses what it holds; what stays in bone stays.
void World::State::let_go_of(const Model& model, std::uint8_t index) noexcept {
  Item& item = now.items[index];
  if (item.hand != kNoHand) return put_down(model, item.hand);
  item.wire = kNoItem;
}

void World::State::bend_wires(const Model& model) noexcept {
  for (std::uint8_t i = 0; i < kMaxItems; ++i) {
    const Item& item = now.items[i];
    const bool stands_out = item.is_there() && item.is_fixed() && !item.is_broken &&
                            kind_of(model, item).work == instruments::Work::Drill;
    if (stands_out) bend_wire(model, i);
  }
}

}  // namespace carpus::simulation
