// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a displaced scaphoid is once it is reduced: what its fixation is after.
#pragma once

#include <optional>

#include "cases/case_data.hpp"

namespace carpus::cases {

/// Of a scaphoid in two pieces whose faces lie apart (anatomy/reduction.hpp) that of the bone with
/// its faces met; nothing of any other. About 1 s; uses `bones` and `scaphoid`.
[[nodiscard]] std::optional<ReducedScaphoid> find_reduced_scaphoid(const CaseData& data);

}  // namespace carpus::cases
