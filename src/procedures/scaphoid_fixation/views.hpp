// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluoroscopic views that show a screw that stands out of the scaphoid, as ranges of the C-arm's
// two angles (docs/scoring.md).
#pragma once

#include <cstdint>
#include <string>

#include "procedure/operation_record.hpp"

namespace carpus::procedures::scaphoid_fixation {

enum class View : std::uint8_t {
  Pa = 0,
  Lateral = 1,
  PronatedOblique =
      2,  ///< 45 degrees pronated: most sensitive for distal penetration [chammasndstandard]
  ProximalPole = 3,  ///< tilted: shows a screw that stands out of the proximal pole [skyline2021]
};
inline constexpr int kViewCount = 4;

/// "45° pronated oblique".
[[nodiscard]] std::string in_words(View view);

/// Whether a shot at these angles counts as this view. Plain comparisons: safe in the tick.
[[nodiscard]] bool shows(View view, double rotation_deg, double tilt_deg) noexcept;

/// Bit i: View i was taken once one of `steps` (bits of completed_steps) was done.
[[nodiscard]] unsigned views_after(const procedure::OperationRecord& record, std::uint32_t steps);

/// " Taken: PA 2, lateral 2, …."
[[nodiscard]] std::string views_taken(const procedure::OperationRecord& record);

}  // namespace carpus::procedures::scaphoid_fixation
