// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a score separates scripted trainees of graded skill: in silico, never a study on people.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "procedure/procedure.hpp"
#include "procedure/score.hpp"
#include "trainee/skill.hpp"

namespace carpus::trainee {

/// One scored operation.
struct ScoredOperation {
  Skill skill = Skill::Expert;
  std::size_t case_index = 0;
  procedure::ScoreReport score;
};

/// How well one figure tells experts from novices.
struct Separation {
  /// That a random expert does better than a random novice, equals counting half: the area under
  /// the ROC curve [hanley1982auc]; 0.5 is chance.
  double auc = 0.5;
  /// Difference of the means by the pooled deviation (Cohen's d); none where nothing varies.
  std::optional<double> effect_size;
};

/// Of one skill's operations, where the case has such a thing.
struct ItemMeans {
  double earned_share =
      0.0;  ///< of the points, by the value alone; what was not measured earns none
  double measured_share = 0.0;  ///< of the operations
  std::optional<double> value;  ///< where it was measured
};

struct ItemValidity {
  std::string id;
  bool counted = false;   ///< it has a weight
  Separation separation;  ///< by what it earns
  /// Of those operations alone that came to have something to measure; empty where a skill has
  /// none. Who does not get so far earns nothing, which separates whatever the figure is worth.
  std::optional<Separation> where_measured;
  std::array<ItemMeans, kSkillCount> means{};
  /// Novice <= middle <= expert in what is earned.
  [[nodiscard]] bool is_in_order() const noexcept;
};

/// Of each skill's operations on one case, how many missed a must-have.
struct MissedShare {
  std::string id;
  std::array<double, kSkillCount> share{};
};

/// Mean total of each skill on one case, how well it separates there, the share of safe fixations,
/// and what made the others unsafe.
struct CaseMeans {
  Separation separation;  ///< of the total, of experts from novices
  std::array<double, kSkillCount> total{};
  std::array<double, kSkillCount> safe_share{};
  std::vector<MissedShare> missed;  ///< in the procedure's order; what nobody missed is left out
  /// Novice < middle < expert.
  [[nodiscard]] bool is_in_order() const noexcept;
};

struct ProcedureValidity {
  std::string name;
  Separation total;
  std::vector<ItemValidity> items;
  std::vector<CaseMeans> cases;
};

/// @param better, worse  figures of which more is better; neither empty.
[[nodiscard]] Separation separation_of(std::span<const double> better,
                                       std::span<const double> worse);

/// Items are compared by the share of their points that the value earns by itself; what was not
/// measured earns none.
/// @param cases  number of them; every skill has operated on each.
[[nodiscard]] ProcedureValidity validity_of(const procedure::Procedure& procedure,
                                            std::span<const ScoredOperation> operations,
                                            std::size_t cases);

}  // namespace carpus::trainee
