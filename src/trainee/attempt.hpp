// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One whole operation by a scripted trainee.
#pragma once

#include <string>
#include <vector>

#include "cases/case_data.hpp"
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
/// @param posed_case  in its operative posture.
/// @param program_version  written into the recording.
[[nodiscard]] Attempt operate(const cases::CaseData& posed_case,
                              Skill skill,
                              std::uint64_t seed,
                              const std::string& program_version);

}  // namespace carpus::trainee
