// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What looking through the C-arm costs and leaves on record: single shots, and live pictures while
// the foot pedal is down. The pictures themselves are made elsewhere, of what is published.
#include <cstdint>

#include "core/sin_cos.hpp"
#include "core/units.hpp"
#include "procedure/shots.hpp"
#include "simulation/c_arm_angles.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

using detail::absolute;
using procedure::Look;

namespace {

constexpr std::uint32_t kPulseTicks = 1000 / procedure::kPulsesPerSecond;

/// Since a look began the wrist has moved so far that another picture is seen.
bool has_moved_far(const WristPose& now, const WristPose& then) noexcept {
  constexpr double kFarRad = 0.175;  // 10 degrees
  return absolute(now.flexion_rad - then.flexion_rad) > kFarRad ||
         absolute(now.radial_deviation_rad - then.radial_deviation_rad) > kFarRad;
}

}  // namespace

/// How far a beam of these angles [deg, in the room] runs along the line that the procedure is
/// after, |cos|; the angles' meaning is fluoroscopy/c_arm.hpp's.
double World::State::along_aim(const Model& model,
                               double rotation_deg,
                               double tilt_deg) const noexcept {
  const procedure::Aim& aim = model.opening.aim;
  if (aim.body == procedure::kNoBody) return 0.0;
  const SinCos rotation = sin_cos_deg(rotation_deg);
  const SinCos tilt = sin_cos_deg(tilt_deg);
  const double radial = model.data.side == Side::Left ? -1.0 : 1.0;
  const Vec3 towards_source{tilt.sin, radial * rotation.sin * tilt.cos, -rotation.cos * tilt.cos};
  const Vec3 line = (poses[aim.body] * Direction<frame::Bone>{aim.direction}).v;
  return absolute(
      dot((model.data.wrist_from_patient * Direction<frame::Patient>{line}).v, towards_source));
}

/// What of the metal that is operated with lies in the target.
void World::State::note_what_shows(const Model& model, procedure::Shot& shot) const noexcept {
  shot.shows_wire = false;
  shot.shows_screw = false;
  for (const detail::Item& item : now.items) {
    if (!item.is_there() || !item.is_fixed() || !item.in_target) continue;
    const instruments::Work work = kind_of(model, item).work;
    if (work == instruments::Work::Drill) shot.shows_wire = true;
    if (work == instruments::Work::Thread && buried_mm(model, item) >= 0.0) shot.shows_screw = true;
  }
}

/// Puts a look on record. There is room: permission.cpp or `pulse` saw to it.
void World::State::note_look(const Model& model,
                             double rotation_deg,
                             double tilt_deg,
                             Look look) noexcept {
  procedure::Shot& shot = shots[spent.shot_count++];
  // What is seen hangs on how the forearm lies under the C-arm.
  shot.rotation_deg = held_rotation_deg(rotation_deg, spent.wrist.pronation_rad);
  shot.tilt_deg = tilt_deg;
  shot.tick = spent.tick;
  note_what_shows(model, shot);
  shot.along_aim = along_aim(model, rotation_deg, tilt_deg);
  shot.wrist = spent.wrist;
  shot.look = look;
  shot.pulses = look == Look::Single ? procedure::kPulsesPerShot : 0;
  if (look != Look::LiveOn) ++spent.looks;
  shot.tube = spent.tube;
  spent.pulses += shot.pulses;
  spent.dose_units += procedure::dose_units_of(shot);
}

void World::State::take_shot(const Model& model, const Command& command) noexcept {
  note_look(model, command.rotation_deg, command.tilt_deg, Look::Single);
  emit(EventKind::ShotTaken, kNoItem, static_cast<std::int32_t>(spent.looks), 0.0);
}

void World::State::look_through(const Model& model, const CArmInput& raw) noexcept {
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
  if (spent.live_ticks % kPulseTicks == 0) pulse(model);
  ++spent.live_ticks;
}

/// One flash of the tube. A new entry is made where it shows something that the last one did not:
/// another view, the wrist held otherwise, or more that was done. When there is room for no more it
/// counts with the last.
void World::State::pulse(const Model& model) noexcept {
  const CArmInput& stand = spent.c_arm;
  const bool is_first = spent.live_ticks == 0;
  bool is_new = is_first;
  if (!is_first && spent.shot_count > 0) {
    const procedure::Shot& last = shots[spent.shot_count - 1];
    procedure::Shot seen = last;
    seen.rotation_deg = held_rotation_deg(stand.rotation_deg, spent.wrist.pronation_rad);
    seen.tilt_deg = stand.tilt_deg;
    note_what_shows(model, seen);
    is_new = last.look == Look::Single || last.tube != spent.tube ||
             last.shows_wire != seen.shows_wire || last.shows_screw != seen.shows_screw ||
             procedure::are_different_views(seen, last) || has_moved_far(spent.wrist, last.wrist);
  }
  if (is_new && spent.shot_count < kMaxShots) {
    note_look(model, stand.rotation_deg, stand.tilt_deg, is_first ? Look::Live : Look::LiveOn);
  }
  if (is_first) spent.live_look = spent.looks;
  // Where there was no room for an entry of its own, it is told with the setting of the last.
  procedure::Shot& shot = shots[spent.shot_count - 1];
  ++spent.pulses;
  ++shot.pulses;
  spent.dose_units += procedure::dose_units(shot.tube);
}

}  // namespace carpus::simulation
