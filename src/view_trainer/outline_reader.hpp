// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A reader of pictures: where it takes the scaphoid's outline to be on the picture that is shown,
// with its noise, blur and the bones that lie over it. docs/decisions/0040 says why.
#pragma once

#include "fluoroscopy/detector.hpp"
#include "view_trainer/outline_map.hpp"

namespace carpus::view_trainer {

/// How the outline is looked for, all in the bone's plane [mm]. Engineering values.
inline constexpr double kReadWithinMm = 2.0;  ///< to either side of where the bone ends
inline constexpr double kReadEveryMm = 0.4;   ///< along the outline
inline constexpr double kReadStepMm = 0.1;  ///< across it, and the most from one place to the next
inline constexpr double kEdgeHalfWidthMm = 0.3;  ///< brightness is compared so far to either side

/// The outline as read: the closed line, within kReadWithinMm of the true one and bending no faster
/// than kReadStepMm every kReadEveryMm, along which the picture brightens most towards outside.
/// @param picture  without the screw, bone dark on a bright field.
/// @param truth  of the same view.
[[nodiscard]] OutlineMap read_outline(const fluoroscopy::Image& picture, const OutlineMap& truth);

/// How far a read outline is from the true one [mm], along the true one; positive outside.
struct ReadingError {
  double mean_mm = 0.0;
  double deviation_mm = 0.0;
};
[[nodiscard]] ReadingError reading_error(const OutlineMap& read, const OutlineMap& truth);

}  // namespace carpus::view_trainer
