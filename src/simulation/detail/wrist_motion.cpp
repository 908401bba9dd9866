// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wrist follows where it is wanted at a hand's speed, within its limits, as long as nothing
// pins its bones together; bodies and all that is fixed in them go along.
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::absolute;
using detail::bit_of;
using detail::BodyPose;
using detail::Item;

namespace {

constexpr double kTurnRadPerTick = 0.001;   // 57 degrees a second
constexpr double kTractionNPerTick = 0.05;  // 50 N a second
constexpr double kStiffnessNPerMm = 5.0;    // of a nonunion's gap tissue [E]
constexpr double kYieldMmPerTick = 0.005;   // a fragment moves at most 5 mm a second
constexpr double kPressedMm = 0.1;          // a tip this near its surface presses a fragment
constexpr double kGreatestShiftMm = 2.0;    // then ligaments hold it [E]

double towards(double from, double to, double most) noexcept {
  const double way = to - from;
  return way > most ? from + most : (way < -most ? from - most : to);
}

/// Angles within a turn, a pull that a finger trap could bear: what lies beyond is no input.
bool is_input(const WristPose& pose) noexcept {
  constexpr double kTurnRad = 6.3;
  constexpr double kGreatestTractionN = 1000.0;
  return absolute(pose.flexion_rad) <= kTurnRad &&
         absolute(pose.radial_deviation_rad) <= kTurnRad &&
         absolute(pose.pronation_rad) <= kTurnRad &&
         absolute(pose.traction_n) <= kGreatestTractionN;
}

}  // namespace

/// An instrument that lies in two bones which move against each other holds the wrist.
bool World::State::is_wrist_pinned(const Model& model) const noexcept {
  for (const Item& item : now.items) {
    if (!item.is_there() || !item.is_fixed()) continue;
    detail::BodySet entered = 0;
    for (std::size_t i = 0; i < item.crossing_count; ++i) {
      entered |= bit_of(item.crossings[i].body);
    }
    const bool in_target = (entered & model.kinds.target) != 0;
    const detail::BodySet others = entered & ~model.kinds.target;
    if ((in_target && others != 0) || (others & (others - 1U)) != 0) return true;
  }
  return false;
}

void World::State::move_wrist(const Model& model, const WristPose& raw) noexcept {
  if (!is_input(raw)) {
    ++faults.bad_inputs;
    return;
  }
  wrist_before = spent.wrist;
  const WristPose wanted = model.data.hand_motion.limits.clamp(raw);
  const WristPose before = spent.wrist;
  if (wanted == before) {
    if (raw == wanted) spent.wrist_is_told = false;
    return;
  }
  if (is_wrist_pinned(model)) {
    if (!spent.wrist_is_told) emit(EventKind::WristStopped, kNoItem, 0, 0.0);
    spent.wrist_is_told = true;
    return;
  }
  WristPose& pose = spent.wrist;
  pose.flexion_rad = towards(before.flexion_rad, wanted.flexion_rad, kTurnRadPerTick);
  pose.radial_deviation_rad =
      towards(before.radial_deviation_rad, wanted.radial_deviation_rad, kTurnRadPerTick);
  pose.pronation_rad = towards(before.pronation_rad, wanted.pronation_rad, kTurnRadPerTick);
  pose.traction_n = towards(before.traction_n, wanted.traction_n, kTractionNPerTick);
  pose_bodies(model);
  carry_fixed_items();
}

/// Where a fragment is with this shift, hand and forearm as they are held.
BodyPose World::State::shifted_pose(std::uint8_t body, const Vec3& shift) const noexcept {
  BodyPose pose = poses[body];
  pose.translation += pose.rotation * (shift - applied_shift[body]);
  return pose;
}

/// Takes this tick's motion of the wrist back: something is in its way.
void World::State::stop_wrist(const Model& model) noexcept {
  if (spent.wrist == wrist_before) return;
  spent.wrist = wrist_before;
  pose_bodies(model);
  carry_fixed_items();
  if (!spent.wrist_is_told) emit(EventKind::WristStopped, kNoItem, 0, 0.0);
  spent.wrist_is_told = true;
}

/// The bodies' poses from wrist and shifts.
void World::State::pose_bodies(const Model& model) noexcept {
  const auto by_group = model.data.hand_motion.poses_at(spent.wrist);
  for (std::size_t b = 0; b < snapshot.body_count; ++b) {
    poses[b] = by_group[static_cast<std::size_t>(model.groups[b])];
    poses[b].translation += poses[b].rotation * now.shifted[b];
    applied_shift[b] = now.shifted[b];
    inverses[b] = poses[b].inverse();
  }
}

/// What is fixed in bone lies where its body has taken it.
void World::State::carry_fixed_items() noexcept {
  for (Item& item : now.items) {
    if (!item.is_there() || !item.is_fixed()) continue;
    if (item.wire < kMaxItems) {  // a line that is drawn aside takes along what rides on it
      item.direction_in_bone = now.items[item.wire].direction_in_bone;
    }
    const detail::BodyPose& pose = poses[item.body];
    item.tip =
        (pose * Point<frame::Bone>{item.origin_in_bone + item.direction_in_bone * item.travel_mm})
            .v;
    item.shaft = -(pose * Direction<frame::Bone>{item.direction_in_bone}).v;
  }
}

/// Whether the fragment lies deeper in another than it did as scanned, told at the corners of its
/// hull.
bool World::State::is_fragment_inside_another(const Model& model,
                                              std::uint8_t body) const noexcept {
  const BodyPose moved = shifted_pose(body, now.shifted[body]);
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    if (b == body || (model.kinds.fragments & bit_of(b)) == 0) continue;
    for (const Vec3& corner : model.data.bones[body].hull.vertices) {
      const Vec3 local = (inverses[b] * (moved * Point<frame::Bone>{corner})).v;
      if (!tissue.is_near(b, local)) continue;
      const double depth = -tissue.untouched_distance_mm(b, local);
      const double as_scanned = -tissue.untouched_distance_mm(b, corner);
      if (depth > 0.0 && depth > as_scanned) return true;
    }
  }
  return false;
}

/// A fragment of a nonunion gives way along a push, against its gap tissue.
void World::State::push_fragment(const Model& model, const Item& item, double force_n) noexcept {
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    if ((model.kinds.fragments & bit_of(b)) == 0) continue;
    // Pushed is the fragment in which the tip works; a line through both holds them together.
    const Vec3 tip = item.origin_in_bone + item.direction_in_bone * item.travel_mm;
    const Vec3 local =
        b == item.body ? tip : (inverses[b] * (poses[item.body] * Point<frame::Bone>{tip})).v;
    if (!tissue.is_near(b, local) || tissue.untouched_distance_mm(b, local) > kPressedMm) continue;
    const bool holds_both = item.body != b;
    if (holds_both) return;
    const Vec3 wanted = item.direction_in_bone * (force_n / kStiffnessNPerMm);
    Vec3 step = wanted - now.shifted[b];
    const double far = length(step);
    if (far > kYieldMmPerTick) step *= kYieldMmPerTick / far;
    const Vec3 before = now.shifted[b];
    now.shifted[b] += step;
    const double shifted = length(now.shifted[b]);
    if (shifted > kGreatestShiftMm) now.shifted[b] *= kGreatestShiftMm / shifted;
    if (is_fragment_inside_another(model, b)) now.shifted[b] = before;
  }
  pose_bodies(model);
}

}  // namespace carpus::simulation
