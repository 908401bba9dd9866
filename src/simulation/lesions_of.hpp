// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "cases/case_data.hpp"
#include "cases/joint_lesions.hpp"
#include "procedure/procedure.hpp"

namespace carpus::simulation {

/// What is wrong in a wrist whose examination begins now: what its case has prepared, else drawn by
/// the seed among all grades; none where nothing is examined. A recording keeps it.
[[nodiscard]] std::optional<cases::PreparedPathology> pathology_to_begin_with(
    const procedure::Procedure& procedure,
    std::uint64_t seed,
    const std::optional<cases::PreparedPathology>& of_case);

/// What is wrong in the joints of an exercise: what an examination asks about, as it was prepared,
/// else, of a recording that names no grades, by the seed; what lies loose, or what is to be shaved
/// away, by the seed; none where the procedure is about neither, or the case has no soft tissue.
[[nodiscard]] std::optional<cases::JointLesions> lesions_of(
    const cases::CaseData& data,
    const procedure::Procedure& procedure,
    std::uint64_t seed,
    const std::optional<cases::PreparedPathology>& prepared = {});

}  // namespace carpus::simulation
