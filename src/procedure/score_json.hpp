// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A score report as JSON: the one form in which it is stored, sent and printed. Keys are listed in
// docs/scoring.md and stable.
#pragma once

#include <string>

#include "procedure/score.hpp"

namespace carpus::procedure {

/// @param indent  spaces per level; negative writes one line.
[[nodiscard]] std::string score_json(const ScoreReport& report, int indent = -1);

/// The tray, in the order of the indices: [{"index", "name", "family", "length_mm",
/// "tip_diameter_mm", "tail_diameter_mm", "wire_diameter_mm", "confirmed"}].
[[nodiscard]] std::string screw_catalogue_json(int indent = -1);

}  // namespace carpus::procedure
