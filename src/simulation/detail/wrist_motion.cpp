// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wrist follows where it is wanted at a hand's speed, within its limits, as long as nothing
// pins its bones together; bodies and all that is fixed in them go along.
#include <cstdint>

#include "cases/joint_under_block.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::absolute;
using detail::BodyPose;
using detail::Item;

namespace {

constexpr double kTurnRadPerTick = 0.001;   // 57 degrees a second
constexpr double kTractionNPerTick = 0.05;  // 50 N a second

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

void World::State::move_wrist(const Model& model, const WristPose& raw) noexcept {
  if (!is_input(raw)) {
    ++faults.bad_inputs;
    return;
  }
  wrist_before = spent.wrist;
  const WristPose wanted = model.data.hand_motion.limits.clamp(raw);
  const WristPose before = spent.wrist;
  ease_carried(model);
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
  const std::uint8_t with = carrier(model);
  const std::uint8_t target = detail::first_of(model.kinds.target);
  const detail::InBone with_from_target =
      with == kNoBody ? detail::InBone{} : inverses[with] * bases[target];
  const detail::Displacement carried_before = now.carried;
  pose_bodies(model);
  if (with != kNoBody) {
    carry_target(model, with, with_from_target);
    if (is_target_inside_another(model)) {
      now.carried = carried_before;
      stop_wrist(model);
    }
  }
  carry_fixed_items();
  bend_wires(model);
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

/// The bodies' poses from the wrist, what carries the target, and where fragments were moved.
void World::State::pose_bodies(const Model& model) noexcept {
  const auto by_group = model.map == nullptr
                            ? model.data.hand_motion.poses_at(spent.wrist)
                            : cases::poses_under_block(model.data.hand_motion, spent.wrist);
  for (std::size_t b = 0; b < snapshot.body_count; ++b) {
    bases[b] = by_group[static_cast<std::size_t>(model.groups[b])];
    if (model.lesions) {
      const Vec3 by = model.lesions->shift_of(b, spent.wrist.traction_n);
      bases[b].translation += (bases[b] * Direction<frame::Bone>{by}).v;
    }
    const bool is_target = (model.kinds.target & detail::bit_of(static_cast<std::uint8_t>(b))) != 0;
    if (is_target && !now.carried.is_none()) bases[b] = bases[b] * now.carried.pose();
    poses[b] = now.moved[b].is_none() ? bases[b] : bases[b] * now.moved[b].pose();
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
    const BodyPose& pose = poses[item.body];
    item.tip =
        (pose * Point<frame::Bone>{item.origin_in_bone + item.direction_in_bone * item.travel_mm})
            .v;
    item.shaft = -(pose * Direction<frame::Bone>{item.direction_in_bone}).v;
  }
}

}  // namespace carpus::simulation
