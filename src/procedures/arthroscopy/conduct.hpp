// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What arthroscopies of the wrist share [clinical: B7, B8]: how they begin, predicates of their
// steps, and the figures of how a joint was looked round in (docs/scoring.md defines each).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/grading.hpp"
#include "procedure/operation_record.hpp"
#include "procedure/procedure.hpp"

namespace carpus::procedures::arthroscopy {

/// All predicates by name: `is_pulled`, `is_scope_in`, `is_probe_in`, `has_seen_radial`, ...
[[nodiscard]] std::span<const procedure::NamedPredicate> named_predicates();

/// The hand waits before the 3-4 portal.
/// @param name  of the procedure, for what is said where it cannot be done.
/// @throws InvalidInput  without radius, soft tissue, or portals 3-4 and 4-5.
[[nodiscard]] procedure::Opening opening(const cases::CaseData& data, std::string_view name);

/// @throws InvalidInput  where the case lacks a place that the exercises go by, naming it.
void refuse_without_places(const cases::CaseData& data,
                           const procedure::ScopeDrill& drill,
                           std::string_view name);

/// `points_seen`, `points_seen_share`, `points_probed`, `cartilage_seen_share`, `scope_path_mm`,
/// `probe_path_mm`, `scope_smoothness`, `probe_smoothness`, `cartilage_scuffs`, `pull_outs`,
/// `capsule_pushes`, `force_over_3_n_s`, `force_over_8_n_s`, `horizon_off_share`, `looking_s`,
/// procedure::thrift_measures, structures_struck and nearest_structures.
[[nodiscard]] std::vector<procedure::Measure> conduct_measures(
    const cases::CaseData& data,
    const procedure::Procedure& procedure,
    const procedure::OperationRecord& record);

/// `clouded_share`, `pressure_over_limit_s`, `fluid_in_tissue_ml`, of procedures that declare
/// fluid.
void add_fluid_measures(std::vector<procedure::Measure>& measures,
                        const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopy
