// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Inflamed synovium in the radiocarpal joint, to be shaved away under sight [clinical: B7, B8]:
// procedure.json and what of it needs code.
#pragma once

#include <string_view>

#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopic_synovectomy {

/// The text of procedure.json, built in by CMakeLists.txt.
[[nodiscard]] std::string_view json();

/// Read once, on the first call. @throws InvalidInput  when procedure.json is wrong.
[[nodiscard]] const procedure::Procedure& declared();

}  // namespace carpus::procedures::arthroscopic_synovectomy
