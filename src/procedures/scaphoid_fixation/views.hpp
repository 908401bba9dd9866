// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluoroscopic views that show a screw that stands out of the scaphoid, as ranges of the C-arm's
// two angles (docs/scoring.md).
#pragma once

#include <cstdint>
#include <span>
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

/// Bits of the views that a wire, and that a screw, is to be seen in before one goes on.
inline constexpr unsigned kViewsOfWire = 0b0111;
inline constexpr unsigned kViewsOfScrew = 0b1111;

/// "45° pronated oblique".
[[nodiscard]] std::string in_words(View view);

/// Whether a shot at these angles counts as this view. Plain comparisons: safe in the tick.
[[nodiscard]] bool shows(View view, double rotation_deg, double tilt_deg) noexcept;

/// Bit i: View i was taken while a wire lay in the target and no screw yet, or (`of_screw`) while a
/// screw was seated there. Plain comparisons: safe in the tick.
[[nodiscard]] unsigned views_of(std::span<const procedure::Shot> shots, bool of_screw) noexcept;

/// "Taken: PA 2, lateral 2, …."
[[nodiscard]] std::string views_taken(const procedure::OperationRecord& record);

/// "PA 1.0, lateral 0.5, others 2.0 cGy cm²."
[[nodiscard]] std::string doses_by_view(const procedure::OperationRecord& record);

}  // namespace carpus::procedures::scaphoid_fixation
