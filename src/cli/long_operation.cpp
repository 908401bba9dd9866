// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/long_operation.hpp"

#include "core/version.hpp"
#include "simulation/keyframe_due.hpp"
#include "simulation/world.hpp"
#include "trainee/scripted_trainee.hpp"

namespace carpus::cli {
namespace {

/// Kept for the expert at the end, who needs longer.
constexpr Tick kExpertTicks = 40'000;
constexpr std::uint64_t kSeed = 1;

/// To and fro about where the instrument waits, within some millimetres, another wish each tick.
simulation::HandInput searching(const simulation::HandInput& rest, Tick tick) {
  simulation::HandInput hand = rest;
  const auto phase = static_cast<double>(tick % 4000) / 4000.0;
  const double way = phase < 0.5 ? 4 * phase - 1 : 3 - 4 * phase;
  const auto turn = static_cast<double>(tick % 1700) / 1700.0;
  const double side = turn < 0.5 ? 4 * turn - 1 : 3 - 4 * turn;
  hand.tip_in_patient += hand.shaft_in_patient * (3.0 * way) + Vec3{side, -side, way};
  return hand;
}

}  // namespace

LongOperation make_long_operation(const cases::CaseData& data,
                                  const procedure::Procedure& procedure,
                                  Tick ticks) {
  simulation::World world(data, procedure, kSeed);
  simulation::Recorder recorder(kProgramVersion, simulation::fingerprint_of(data), world);
  trainee::ScriptedTrainee expert(data, procedure, trainee::Skill::Expert, kSeed);
  LongOperation made;
  const auto step = [&](const simulation::Input& input) {
    recorder.append(input);
    const simulation::Snapshot& now = world.step(input);
    for (std::size_t i = 0; i < now.event_count; ++i) {
      if (now.events[i].kind == simulation::EventKind::ShotTaken) made.shots.push_back(now.tick);
    }
    if (simulation::is_keyframe_due(now)) {
      recorder.append_keyframe({now.tick, world.write_state()});
    }
  };
  simulation::Input input;
  input.wrist = world.now().wrist;
  for (std::size_t h = 0; h < simulation::kHands; ++h) {
    input.hands[h].tip_in_patient = world.now().items[0].tip_in_patient;
    input.hands[h].shaft_in_patient = world.now().items[0].shaft_in_patient;
  }
  const simulation::HandInput rest = input.hands[0];
  while (world.now().tick + kExpertTicks < ticks) {
    input.hands[0] = searching(rest, world.now().tick);
    step(input);
  }
  while (!world.now().finished) step(expert.next(world.now()));
  made.recording = recorder.finished(world.now().state_hash);
  return made;
}

}  // namespace carpus::cli
