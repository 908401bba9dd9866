// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A torn disc whose loose edges are trimmed with a shaver, its rim kept [clinical: B7, B8]:
// procedure.json and what of it needs code.
#pragma once

#include <string_view>

#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopic_disc_debridement {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when procedure.json is wrong.
[[nodiscard]] const procedure::Procedure& declared();

}  // namespace carpus::procedures::arthroscopic_disc_debridement
