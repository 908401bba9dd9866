// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which steps of the procedure are done.
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

using procedure::Step;

constexpr double kDriveDoneShare = 0.6;  // of the line's length inside the scaphoid

double absolute(double value) noexcept { return value < 0 ? -value : value; }

}  // namespace

void World::State::complete(Step step) noexcept {
  if ((now.completed_steps & detail::step_bit(step)) != 0) return;
  now.completed_steps |= detail::step_bit(step);
  emit(EventKind::StepCompleted, static_cast<std::int32_t>(step), 0.0);
}

/// Whether the shots from `first_shot` on hold two different views, and the oblique if needed.
bool World::State::are_views_enough(std::uint32_t first_shot, bool needs_oblique) const noexcept {
  bool has_two = false;
  bool has_oblique = !needs_oblique;
  for (std::uint32_t i = first_shot; i < spent.shot_count; ++i) {
    const procedure::Shot& shot = shots[i];
    const procedure::Shot& first = shots[first_shot];
    has_two = has_two ||
              absolute(shot.rotation_deg - first.rotation_deg) >= procedure::kDifferentViewDeg ||
              absolute(shot.tilt_deg - first.tilt_deg) >= procedure::kDifferentViewDeg;
    has_oblique = has_oblique || procedure::shows(procedure::View::PronatedOblique,
                                                  shot.rotation_deg, shot.tilt_deg);
  }
  return has_two && has_oblique;
}

void World::State::tick_off_steps() noexcept {
  if ((now.completed_steps & detail::step_bit(Step::Survey)) == 0 && are_views_enough(0, false)) {
    complete(Step::Survey);
  }
  const bool is_driven = now.wire.in_scaphoid && depth_mm() >= kDriveDoneShare * now.wire.chord_mm;
  if (is_driven && (now.completed_steps & detail::step_bit(Step::Drive)) == 0) {
    now.shots_before_drive = spent.shot_count;
    complete(Step::Drive);
  }
  if ((now.completed_steps & detail::step_bit(Step::Drive)) != 0 &&
      (now.completed_steps & detail::step_bit(Step::Check)) == 0 &&
      are_views_enough(now.shots_before_drive, true)) {
    complete(Step::Check);
  }
  if (now.measured_mm >= 0.0) complete(Step::Measure);
  if (now.screw.index >= 0) complete(Step::Choose);
  if (now.screw.index >= 0 && buried_mm() >= 0.0) complete(Step::Insert);
}

}  // namespace carpus::simulation
