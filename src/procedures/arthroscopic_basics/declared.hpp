// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// First exercises with a scope and a probe in the radiocarpal joint [clinical: B7, B8, C2]:
// procedure.json and what of it needs code.
#pragma once

#include <string_view>

#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopic_basics {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when procedure.json is wrong.
[[nodiscard]] const procedure::Procedure& declared();

/// How it begins, or why it cannot, of these exercises in any grade of difficulty.
[[nodiscard]] procedure::Opening opened(const procedure::Procedure& graded,
                                        const cases::CaseData& data);
/// By that one's rules (docs/scoring.md).
[[nodiscard]] procedure::ScoreReport scored(const procedure::Procedure& graded,
                                            const cases::CaseData& data,
                                            const procedure::OperationRecord& record);

/// By the rules in procedure.json.
[[nodiscard]] procedure::ScoreReport score(const cases::CaseData& data,
                                           const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopic_basics
