// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From figures to a graded report, by the rules in a procedure's data.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "procedure/score.hpp"
#include "procedure/score_rules.hpp"

namespace carpus::procedure {

/// What was measured under an id.
struct Measure {
  std::string_view id;
  std::optional<double> value;  ///< empty where there was nothing to measure
  std::string finding;          ///< what was seen, one or two sentences; may be empty
  bool applies = true;          ///< false: this case has no such thing; it is left out
};

/// Items, must-haves, verdict and `overall`: the share of the weights that was earned, to 100; 0
/// where a must-have is missing, for then nothing earns points. Everything else of the report is
/// left as it was.
/// @throws InvalidInput when a rule names a measure that there is not.
void grade(ScoreReport& report, const ScoreRules& rules, std::span<const Measure> measures);

/// Share of a rule's points that a value earns by itself, whatever else was done [1].
[[nodiscard]] double earned_share(const ScoreRule& rule, double value);

/// "1.25 to 2.75 mm good; under 0.5 or over 6 mm fails".
[[nodiscard]] std::string target_text(const ScoreRule& rule);

}  // namespace carpus::procedure
