// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The figures of how a punch bit (docs/scoring.md defines each).
#pragma once

#include <vector>

#include "procedure/grading.hpp"
#include "procedure/punching.hpp"

namespace carpus::procedures::arthroscopy {

/// `bitten_unseen`, `bitten_empty`, `bitten_cartilage`, `bitten_lining`: how many bites of each.
/// @param has_worked  else none is measured: who does not work has no faults
[[nodiscard]] std::vector<procedure::Measure> punch_measures(const procedure::PunchFacts& done,
                                                             bool has_worked);

}  // namespace carpus::procedures::arthroscopy
