// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How hard a case is, from its geometry alone.
#pragma once

#include <optional>

#include "cases/case_data.hpp"
#include "cases/lesson.hpp"

namespace carpus::cases {

/// Of a fracture, as its truth has it; frame Patient.
struct FractureFacts {
  Vec3 point;   ///< on its mean plane
  Vec3 normal;  ///< unit
  double gap_mm = 0;
  double step_mm = 0;
  double flexion_deg = 0;
};

/// Measures the corridor along the central axis and makes a figure of it (docs/case_format.md):
/// 40 points for a narrow corridor (none at 2 mm around the screw, all at 0.3 mm), 30 for a short
/// fragment (12 to 4 mm), 10 for a short corridor (24 to 14 mm), 20 for the worst of gap (1 to 2.5
/// mm), step (0.5 to 2 mm) and flexion (3 to 20 degrees). Engineering values.
/// @param screw_radius_mm  of the smallest screw on the tray, over its thread.
[[nodiscard]] Difficulty difficulty_of(const ScaphoidLandmarks& scaphoid,
                                       const std::optional<FractureFacts>& fracture,
                                       double screw_radius_mm);

}  // namespace carpus::cases
