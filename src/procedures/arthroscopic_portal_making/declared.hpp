// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The making of portals through closed skin, 3-4 and another by the exercise's seed [clinical: B7]:
// procedure.json and what of it needs code.
#pragma once

#include <string_view>

#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopic_portal_making {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when procedure.json is wrong.
[[nodiscard]] const procedure::Procedure& declared();

[[nodiscard]] procedure::ScoreReport score(const cases::CaseData& data,
                                           const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopic_portal_making
