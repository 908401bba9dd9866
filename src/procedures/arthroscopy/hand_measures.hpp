// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How smoothly both hands were led, and what cartilage they scuffed (docs/scoring.md).
#pragma once

#include <string_view>

#include "cases/case_data.hpp"
#include "procedure/grading.hpp"
#include "procedure/operation_record.hpp"

namespace carpus::procedures::arthroscopy {

/// Fewer stretches tell no habit: 50 mm of way [E].
inline constexpr std::uint32_t kLeastStretches = 10;

/// Log dimensionless jerk: of a minimum-jerk reach -5.3, less is jerkier. Not measured where the
/// instrument hardly moved in a joint: who holds still shows no smooth hand.
[[nodiscard]] procedure::Measure smoothness(std::string_view id,
                                            const procedure::SmoothnessFacts& facts);

/// `cartilage_scuffs`, with the bones. Not measured where no scope went in.
[[nodiscard]] procedure::Measure cartilage_scuffs(const cases::CaseData& data,
                                                  const procedure::ScopeRecord& scope);

/// The places, for who draws them.
void tell_scuffs(procedure::ScoreReport& report,
                 const cases::CaseData& data,
                 const procedure::OperationRecord& record);

}  // namespace carpus::procedures::arthroscopy
