// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a procedure asks about the joints that were looked into.
#pragma once

#include "arthroscopy/pathology_table.hpp"
#include "procedure/procedure.hpp"

namespace carpus::simulation {

/// nullptr where nothing is asked. Real-time after the first call.
[[nodiscard]] const arthroscopy::PathologyTable* questions_of(
    const procedure::Procedure& procedure);

}  // namespace carpus::simulation
