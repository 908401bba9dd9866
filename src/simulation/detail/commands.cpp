// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the person commands: shots, measuring, choosing a screw, undo, finish.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

using procedure::Step;

constexpr double kGaugeStepMm = 0.5;  // scale of the depth gauge

double absolute(double value) noexcept { return value < 0 ? -value : value; }

}  // namespace

void World::State::save_checkpoint() noexcept {
  if (checkpoint_count == checkpoints.size()) {  // the oldest is forgotten
    for (std::size_t i = 1; i < checkpoints.size(); ++i) checkpoints[i - 1] = checkpoints[i];
    --checkpoint_count;
  }
  checkpoints[checkpoint_count++] = now;
}

void World::State::obey(const Model& model, const Command& command) noexcept {
  switch (command.kind) {
    case CommandKind::None:
      return;
    case CommandKind::TakeShot:
      return take_shot(command);
    case CommandKind::Measure:
      return measure(model);
    case CommandKind::SelectScrew:
      return select_screw(model, command.index);
    case CommandKind::Undo:
      return undo();
    case CommandKind::Finish:
      return finish();
  }
  refuse(command.kind);
}

void World::State::take_shot(const Command& command) noexcept {
  const bool is_in_range =
      absolute(command.rotation_deg) <= 180.0 && absolute(command.tilt_deg) <= 60.0;
  if (!is_in_range || spent.shot_count >= kMaxShots) return refuse(CommandKind::TakeShot);
  procedure::Shot& shot = shots[spent.shot_count++];
  shot.rotation_deg = command.rotation_deg;
  shot.tilt_deg = command.tilt_deg;
  shot.tick = spent.tick;
  shot.wire_in_bone = (now.completed_steps & detail::step_bit(Step::Drive)) != 0;
  shot.screw_in = now.screw.index >= 0 && buried_mm() >= 0.0;
  emit(EventKind::ShotTaken, static_cast<std::int32_t>(spent.shot_count), 0.0);
}

void World::State::measure(const Model& /*model*/) noexcept {
  if (!now.wire.in_scaphoid || !(depth_mm() > 0.0)) return refuse(CommandKind::Measure);
  // Between the cortices: what of the wire is beyond the far one does not count.
  const double in_bone = now.wire.has_left ? std::min(depth_mm(), now.wire.chord_mm) : depth_mm();
  const auto steps = std::int64_t{std::lround(in_bone / kGaugeStepMm)};
  now.measured_mm = static_cast<double>(steps) * kGaugeStepMm;
  emit(EventKind::Measured, 0, now.measured_mm);
}

void World::State::select_screw(const Model& model, std::int32_t index) noexcept {
  const bool is_known = index >= 0 && static_cast<std::size_t>(index) < model.screw_count;
  if (!is_known || !now.wire.in_scaphoid || now.screw.advance_mm > 0.0) {
    return refuse(CommandKind::SelectScrew);
  }
  save_checkpoint();
  now.screw = {index, model.screw_lengths[static_cast<std::size_t>(index)], 0.0, false};
  now.instrument = Instrument::ScrewDriver;
  emit(EventKind::ScrewSelected, index, now.screw.length_mm);
}

void World::State::undo() noexcept {
  if (checkpoint_count == 0) return refuse(CommandKind::Undo);
  now = checkpoints[--checkpoint_count];
  ++spent.undos;
  emit(EventKind::Undone, 0, 0.0);
}

void World::State::finish() noexcept {
  const bool was_verified =
      spent.shot_count > 0 && shots[spent.shot_count - 1].screw_in && buried_mm() >= 0.0;
  if (was_verified && now.screw.index >= 0) complete(Step::Verify);
  complete(Step::Finished);
  spent.finished = true;
  emit(EventKind::Finished, 0, 0.0);
}

}  // namespace carpus::simulation
