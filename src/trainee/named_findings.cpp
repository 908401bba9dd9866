// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scripted arthroscopist answers at the end: of what came into view what it recognises, as
// rightly as its skill has it.
#include "arthroscopy/pathology_table.hpp"
#include "simulation/questions.hpp"
#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {

using simulation::CommandKind;

/// One finding a tick.
void ScriptedArthroscopist::answer(const simulation::Snapshot& now, simulation::Input& input) {
  if (answered_ >= asked_->findings.size()) return;
  const std::uint32_t seen = now.scope.lesions_seen;
  const std::uint8_t grade =
      procedure_.examines ? judged(answered_, seen) : judged_of_screw(answered_, seen);
  said_[answered_] = grade;
  input.command.kind = CommandKind::Answer;
  input.command.index = simulation::answer_index(answered_, grade);
  ++answered_;
}

/// What is named of what came into view; what did not is taken for well.
std::uint8_t ScriptedArthroscopist::judged(std::size_t finding, std::uint32_t lesions_seen) {
  const auto grades = arthroscopy::PathologyTable::generic().scale_of(finding).grades.size();
  const auto some = static_cast<std::uint8_t>(1 + rng_.below(grades - 1));
  const double chance = rng_.uniform(0.0, 1.0);
  const double exact = rng_.uniform(0.0, 1.0);
  if (rng_.uniform(0.0, 1.0) < skill_.says_nothing) return simulation::kNoGrade;
  const std::uint8_t truth = lesions_ != nullptr ? lesions_->grades[finding] : std::uint8_t{0};
  bool is_seen = false;
  for (std::size_t i = 0; truth != 0 && i < lesions_->lesions.size(); ++i) {
    const bool is_of_it = lesions_->lesions[i].finding == finding;
    is_seen = is_seen || (is_of_it && (lesions_seen >> i & 1U) != 0);
  }
  if (!is_seen) return chance < skill_.invents ? some : std::uint8_t{0};
  if (chance >= skill_.recognises) return 0;
  if (exact < skill_.grades_right) return truth;
  // The grade beside it.
  if (truth + 1U < grades && (truth == 1 || exact > 0.5 * (1.0 + skill_.grades_right))) {
    return static_cast<std::uint8_t>(truth + 1);
  }
  return truth > 1 ? static_cast<std::uint8_t>(truth - 1) : truth;
}

}  // namespace carpus::trainee
