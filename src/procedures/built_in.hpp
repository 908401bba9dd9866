// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The procedures that the program offers: one folder of this module each.
#pragma once

#include "procedure/procedure.hpp"

namespace carpus::procedures {

/// In the order of CMakeLists.txt: first the dorsal fixation, which is operated when none is named.
/// Read once, on the first call.
/// @throws InvalidInput naming file and field when a procedure.json is wrong.
[[nodiscard]] const procedure::ProcedureList& built_in();

}  // namespace carpus::procedures
