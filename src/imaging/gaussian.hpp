// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Gaussian smoothing and derivatives of a CT, with the width in mm so that voxels of any shape give
// the same picture. Separable; borders are mirrored. Source: [lindeberg1994scale].
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"
#include "imaging/block_view.hpp"

namespace carpus::imaging {

/// Gaussian of standard deviation `sigma_mm` >= 0 [mm]; a constant stays what it is.
[[nodiscard]] Grid<float> gaussian_smooth(const GridView<const float>& image, double sigma_mm);
[[nodiscard]] Grid<float> gaussian_smooth(const BlockView<std::int16_t>& image, double sigma_mm);

/// Length of the gradient of the smoothed image, per mm; a ramp gives its slope.
[[nodiscard]] Grid<float> gradient_magnitude(const GridView<const float>& image, double sigma_mm);
[[nodiscard]] Grid<float> gradient_magnitude(const BlockView<std::int16_t>& image, double sigma_mm);

/// How strongly a voxel lies in a dark sheet or line between brighter parts: the largest eigenvalue
/// of the Hessian of the smoothed image times sigma^2 (scale-normalised, so in the image's unit),
/// where positive, else 0. Joint clefts between bones show in it when their grey value does not.
[[nodiscard]] Grid<float> dark_sheet_measure(const GridView<const float>& image, double sigma_mm);
[[nodiscard]] Grid<float> dark_sheet_measure(const BlockView<std::int16_t>& image, double sigma_mm);

}  // namespace carpus::imaging
