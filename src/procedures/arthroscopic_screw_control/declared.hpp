// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a screw in the scaphoid stands out into a joint [clinical: B1 step 10]: procedure.json
// and what of it needs code.
#pragma once

#include <string_view>

#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopic_screw_control {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when procedure.json is wrong.
[[nodiscard]] const procedure::Procedure& declared();

/// By the rules in procedure.json (docs/scoring.md).
[[nodiscard]] procedure::ScoreReport score(const cases::CaseData& data,
                                           const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopic_screw_control
