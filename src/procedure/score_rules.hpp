// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a procedure's data say of its score: how figures are graded, what each is worth and why, and
// without which no fixation is safe. A surgeon corrects them in procedure.json, without a compiler.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace carpus::procedure {

/// A closed interval, open where a side is infinite. In data: [low, high], null for infinite.
struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contain(double value) const noexcept { return value >= low && value <= high; }
};

/// One figure of the score.
struct ScoreRule {
  std::string id;     ///< of the measure; stable, snake_case, ends with its unit
  std::string label;  ///< for people
  std::string unit;   ///< "deg", "mm", "mm2", "ml", "%", "s", "cGy cm2", "1"
  Limits good;        ///< full points
  Limits fail;        ///< none outside; linear between
  double weight = 0;  ///< 0: measured and told, not counted
  std::string why;    ///< why it matters, one or two sentences
  std::string mark;   ///< where limits come from: "[S50]", "[K]", "[E]"
};

/// Without it nothing earns points.
struct SafetyRule {
  std::string id;
  std::string label;    ///< "Nothing stands out of the bone by more than 0.5 mm"
  std::string measure;  ///< whose value must be within
  Limits within;
  bool opens_truth = false;  ///< without it an assessed operation is void
  std::string mark;
};

struct ScoreRules {
  std::vector<SafetyRule> safety;
  std::vector<ScoreRule> items;
};

/// Why one may decline to operate: a thing that is seen on the pictures.
struct DeclineReason {
  std::string id;     ///< as lessons name it (cases/lesson.hpp)
  std::string label;  ///< for people
};

/// When not to operate: what may be said, and how that is judged.
struct DeclineRules {
  static constexpr std::size_t kMostReasons = 7;  ///< beside one bit of a byte
  std::vector<DeclineReason> reasons;             ///< none: the procedure is never declined
  ScoreRules rules;
};

}  // namespace carpus::procedure
