// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Smoothing of pictures. At the border the nearest pixel repeats.
#pragma once

#include <vector>

namespace carpus::fluoroscopy::detail {

/// Gaussian of deviation `sigma_px`, cut at 3 deviations; the picture itself when it is below 0.1.
[[nodiscard]] std::vector<float> blur_gaussian(const std::vector<float>& picture,
                                               int width,
                                               int height,
                                               double sigma_px);

/// The same for deviations of many pixels: the picture is averaged down, smoothed and read back
/// between its coarse pixels, at a cost that does not grow with sigma.
[[nodiscard]] std::vector<float> blur_wide(const std::vector<float>& picture,
                                           int width,
                                           int height,
                                           double sigma_px);

}  // namespace carpus::fluoroscopy::detail
