// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What looking through the C-arm costs and leaves on record: single shots, and live pictures while
// the foot pedal is down. The pictures themselves are made elsewhere, of what is published.
#include <cstdint>

#include "core/units.hpp"
#include "procedure/shots.hpp"
#include "simulation/c_arm_angles.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using procedure::Look;

namespace {

constexpr std::uint32_t kPulseTicks = 1000 / procedure::kPulsesPerSecond;

}  // namespace

/// Puts a look on record. There is room: permission.cpp or `pulse` saw to it.
void World::State::note_look(double rotation_deg, double tilt_deg, Look look) noexcept {
  procedure::Shot& shot = shots[spent.shot_count++];
  // What is seen hangs on how the forearm lies under the C-arm.
  shot.rotation_deg = held_rotation_deg(rotation_deg, spent.wrist.pronation_rad);
  shot.tilt_deg = tilt_deg;
  shot.tick = spent.tick;
  shot.completed_steps = now.completed_steps;
  shot.wrist = spent.wrist;
  shot.look = look;
  shot.pulses = look == Look::Single ? procedure::kPulsesPerShot : 0;
  if (look != Look::LiveOn) ++spent.looks;
  spent.pulses += shot.pulses;
}

void World::State::take_shot(const Command& command) noexcept {
  note_look(command.rotation_deg, command.tilt_deg, Look::Single);
  emit(EventKind::ShotTaken, kNoItem, static_cast<std::int32_t>(spent.looks), 0.0);
}

void World::State::look_through(const CArmInput& raw) noexcept {
  CArmInput wanted = raw;
  if (!can_stand(raw.rotation_deg, raw.tilt_deg)) {
    ++faults.bad_inputs;
    wanted = spent.c_arm;
    wanted.pedal_is_down = false;
  }
  spent.c_arm = wanted;
  if (!wanted.pedal_is_down) {
    if (spent.live_ticks == 0) return;
    emit(EventKind::LiveEnded, kNoItem, static_cast<std::int32_t>(spent.live_look),
         spent.live_ticks * kTickSeconds);
    spent.live_ticks = 0;
    return;
  }
  if (spent.live_ticks % kPulseTicks == 0) pulse();
  ++spent.live_ticks;
}

/// One flash of the tube. A new entry is made where it shows something that the last one did not:
/// another view, or more that was done. When there is room for no more it counts with the last.
void World::State::pulse() noexcept {
  const CArmInput& stand = spent.c_arm;
  const bool is_first = spent.live_ticks == 0;
  bool is_new = is_first;
  if (!is_first && spent.shot_count > 0) {
    const procedure::Shot& last = shots[spent.shot_count - 1];
    procedure::Shot seen = last;
    seen.rotation_deg = held_rotation_deg(stand.rotation_deg, spent.wrist.pronation_rad);
    seen.tilt_deg = stand.tilt_deg;
    is_new = last.look == Look::Single || last.completed_steps != now.completed_steps ||
             procedure::are_different_views(seen, last);
  }
  if (is_new && spent.shot_count < kMaxShots) {
    note_look(stand.rotation_deg, stand.tilt_deg, is_first ? Look::Live : Look::LiveOn);
  }
  if (is_first) spent.live_look = spent.looks;
  ++spent.pulses;
  ++shots[spent.shot_count - 1].pulses;
}

}  // namespace carpus::simulation
