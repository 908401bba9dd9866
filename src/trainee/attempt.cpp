// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/attempt.hpp"

#include "simulation/keyframe_due.hpp"
#include "simulation/lesions_of.hpp"
#include "simulation/world.hpp"
#include "trainee/arthroscopist.hpp"
#include "trainee/entering_arthroscopist.hpp"
#include "trainee/portal_maker.hpp"
#include "trainee/scripted_trainee.hpp"

namespace carpus::trainee {

namespace {

/// What is wrong is before the operator's eyes, as far as it comes into view.
void show(ScriptedArthroscopist& trainee, const simulation::World& world) {
  trainee.examines(world.lesions());
}
void show(ScriptedTrainee&, const simulation::World&) {}
void show(ScriptedPortalMaker&, const simulation::World&) {}
void show(EnteringArthroscopist&, const simulation::World&) {}

simulation::World begun(const cases::CaseData& data,
                        const procedure::Procedure& procedure,
                        std::uint64_t seed) {
  return {data, procedure, seed, procedure::Mode::Practice,
          simulation::pathology_to_begin_with(procedure, seed, data.pathology)};
}

template <typename Trainee>
Attempt operate_as(Trainee trainee,
                   const cases::CaseData& data,
                   const procedure::Procedure& procedure,
                   std::uint64_t seed,
                   const std::string& program_version) {
  simulation::World world = begun(data, procedure, seed);
  show(trainee, world);
  simulation::Recorder recorder(program_version, simulation::fingerprint_of(data), world);
  Attempt attempt;
  while (!world.now().finished) {
    const simulation::Input input = trainee.next(world.now());
    recorder.append(input);
    const simulation::Snapshot& now = world.step(input);
    for (std::size_t i = 0; i < now.event_count; ++i) attempt.events.push_back(now.events[i]);
    if (simulation::is_keyframe_due(now)) {
      recorder.append_keyframe({recorder.tick(), world.write_state()});
    }
  }
  attempt.last = world.now();
  attempt.recording = recorder.finished(attempt.last.state_hash);
  attempt.record = world.operation_record();
  attempt.score = procedure.score(data, attempt.record);
  return attempt;
}

template <typename Trainee>
procedure::ScoreReport score_as(Trainee trainee,
                                const cases::CaseData& data,
                                const procedure::Procedure& procedure,
                                std::uint64_t seed) {
  simulation::World world = begun(data, procedure, seed);
  show(trainee, world);
  world.leave_out_hashes();
  while (!world.now().finished) world.step(trainee.next(world.now()));
  return procedure.score(data, world.operation_record());
}

}  // namespace

Attempt operate(const cases::CaseData& data,
                const procedure::Procedure& procedure,
                Skill skill,
                std::uint64_t seed,
                const std::string& program_version) {
  if (is_arthroscopy(procedure)) {
    return operate_as(ScriptedArthroscopist(data, procedure, skill, seed), data, procedure, seed,
                      program_version);
  }
  if (EnteringArthroscopist::knows(procedure)) {
    return operate_as(EnteringArthroscopist(data, procedure, skill, seed), data, procedure, seed,
                      program_version);
  }
  if (procedure.making) {
    return operate_as(ScriptedPortalMaker(data, procedure, skill, seed), data, procedure, seed,
                      program_version);
  }
  return operate_as(ScriptedTrainee(data, procedure, skill, seed), data, procedure, seed,
                    program_version);
}

procedure::ScoreReport score_of_operation(const cases::CaseData& data,
                                          const procedure::Procedure& procedure,
                                          Skill skill,
                                          std::uint64_t seed) {
  if (is_arthroscopy(procedure)) {
    return score_as(ScriptedArthroscopist(data, procedure, skill, seed), data, procedure, seed);
  }
  if (EnteringArthroscopist::knows(procedure)) {
    return score_as(EnteringArthroscopist(data, procedure, skill, seed), data, procedure, seed);
  }
  if (procedure.making) {
    return score_as(ScriptedPortalMaker(data, procedure, skill, seed), data, procedure, seed);
  }
  return score_as(ScriptedTrainee(data, procedure, skill, seed), data, procedure, seed);
}

}  // namespace carpus::trainee
