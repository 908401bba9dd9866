// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/json_fields.hpp"
#include "procedure/score_rules.hpp"

namespace carpus::procedure::detail {

/// Reads "safety" and "score" of a procedure.json.
/// @throws InvalidInput "dorsal.json: score[2]: fail lies inside good".
[[nodiscard]] ScoreRules read_score_rules(JsonFields& fields);

/// Reads "decline"; no reasons where there is none.
[[nodiscard]] DeclineRules read_decline_rules(JsonFields& fields);

}  // namespace carpus::procedure::detail
