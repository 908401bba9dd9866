// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an operation did to tendons, arteries and nerves, or how near it came (docs/scoring.md).
// They are generated: neither figure applies to a case that has none.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/grading.hpp"
#include "procedure/operation_record.hpp"

namespace carpus::procedure {

/// What went through it: a wire that turns, or what makes or uses an arthroscopy's portal.
enum class ThroughSkin : std::uint8_t { Wire, Portal };

/// `structures_struck`: how many, the finding naming each and how it is spared on that way.
/// @param did  " turned in the "
[[nodiscard]] Measure structures_struck(const cases::CaseData& data,
                                        const OperationRecord& record,
                                        std::string_view did,
                                        ThroughSkin way);

/// `nearest_tendon_mm`, `nearest_artery_mm`, `nearest_nerve_mm`.
/// @param nothing  what is said where nothing came near.
[[nodiscard]] std::vector<Measure> nearest_structures(const cases::CaseData& data,
                                                      const OperationRecord& record,
                                                      std::string_view nothing);

}  // namespace carpus::procedure
