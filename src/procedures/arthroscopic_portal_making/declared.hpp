// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The making of portals through closed skin, 3-4 and another by the exercise's seed [clinical: B7]:
// procedure.json and what of it needs code.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "procedure/grading.hpp"
#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopic_portal_making {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when procedure.json is wrong.
[[nodiscard]] const procedure::Procedure& declared();

/// Of its steps, in any grade of difficulty.
[[nodiscard]] std::span<const procedure::NamedPredicate> named_predicates();

/// How it begins, or why it cannot, in any grade.
[[nodiscard]] procedure::Opening opened(const procedure::Procedure& graded,
                                        const cases::CaseData& data);
/// What is measured of it, in any grade (docs/scoring.md).
[[nodiscard]] std::vector<procedure::Measure> measures_of(const procedure::Procedure& graded,
                                                          const cases::CaseData& data,
                                                          const procedure::OperationRecord& record);
/// By that one's rules.
[[nodiscard]] procedure::ScoreReport scored(const procedure::Procedure& graded,
                                            const cases::CaseData& data,
                                            const procedure::OperationRecord& record);

/// By the rules in procedure.json.
[[nodiscard]] procedure::ScoreReport score(const cases::CaseData& data,
                                           const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopic_portal_making
