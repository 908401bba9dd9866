// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One whole operation by a scripted trainee.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"
#include "procedure/score.hpp"
#include "simulation/recording.hpp"
#include "simulation/snapshot.hpp"
#include "trainee/skill.hpp"

namespace carpus::trainee {

struct Attempt {
  simulation::Recording recording;
  simulation::Snapshot last;
  std::vector<simulation::Event> events;
  procedure::OperationRecord record;
  procedure::ScoreReport score;
};

/// Operates from the first tick to Finish, as fast as it can, and scores it.
/// @param data  as scanned; it and the procedure must outlive the call only.
/// @param program_version  written into the recording.
/// @throws InvalidInput  when the scripts do not know how to do this procedure, or it cannot be
/// done
///     on this case.
[[nodiscard]] Attempt operate(const cases::CaseData& data,
                              const procedure::Procedure& procedure,
                              Skill skill,
                              std::uint64_t seed,
                              const std::string& program_version);

/// The score of the same operation, of which nothing else is kept: for studies, in two thirds of
/// the time.
[[nodiscard]] procedure::ScoreReport score_of_operation(const cases::CaseData& data,
                                                        const procedure::Procedure& procedure,
                                                        Skill skill,
                                                        std::uint64_t seed);

}  // namespace carpus::trainee
