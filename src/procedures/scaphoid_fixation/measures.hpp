// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The figures of a scaphoid fixation, by the ids under which the rules in procedure.json grade them
// (docs/scoring.md defines each).
#pragma once

#include <vector>

#include "procedure/grading.hpp"
#include "procedures/scaphoid_fixation/facts.hpp"

namespace carpus::procedures::scaphoid_fixation {

/// Where wire and screw lie: `screw_placed`, `waist_offset_percent`, `proximal_offset_percent`,
/// `distal_offset_percent`, `bone_beside_screw_mm`, `usable_length_percent`,
/// `angle_to_central_axis_deg`, `proximal_cover_mm`, `distal_cover_mm`, `penetration_mm`,
/// `screw_in_smaller_fragment_mm`, `screw_length_minus_ideal_mm`, `gauge_minus_line_mm`,
/// `hold_percent`.
[[nodiscard]] std::vector<procedure::Measure> placement_measures(const Facts& facts);

/// How it went: `wire_passes`, `far_exits`, `beyond_far_cortex_mm`, `wrong_bones_entered`,
/// `ream_short_of_far_cortex_mm`, `trapezium_cartilage_mm2`, `views_with_wire`,
/// `views_with_screw`, `wires_left_in`, and procedure::thrift_measures.
[[nodiscard]] std::vector<procedure::Measure> conduct_measures(const Facts& facts);

/// What turned near tendons, arteries and nerves: `structures_struck`, `nearest_tendon_mm`,
/// `nearest_artery_mm`, `nearest_nerve_mm`. They do not apply to a case that has none.
[[nodiscard]] std::vector<procedure::Measure> structure_measures(const Facts& facts);

/// Whether to fix or to decline was right, by the case's lesson: `fixing_is_right` (1 or 0; left
/// out where nobody wrote a lesson) and, of declining, `declining_is_right`,
/// `right_reasons_percent`, `wrong_reasons`, `views_before_declining`, `bone_entered`.
[[nodiscard]] procedure::Measure fixing_is_right(const cases::CaseData& data);
[[nodiscard]] std::vector<procedure::Measure> decline_measures(
    const cases::CaseData& data,
    const procedure::OperationRecord& record,
    const procedure::Procedure& procedure);

/// Placement, conduct and structures, graded by the procedure's rules; of an operation that was
/// declined, that.
[[nodiscard]] procedure::ScoreReport score(const cases::CaseData& data,
                                           const procedure::OperationRecord& record,
                                           const Fixation& fixation);

}  // namespace carpus::procedures::scaphoid_fixation
