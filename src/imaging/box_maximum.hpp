// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The greatest value near each voxel.
#pragma once

#include "geometry/grid.hpp"

namespace carpus::imaging {

/// Maximum over the box of half-width `reach_mm` (rounded to whole voxels per axis) about each
/// voxel, cut at the volume. Separable.
[[nodiscard]] Grid<float> box_maximum(Grid<float> image, double reach_mm);

}  // namespace carpus::imaging
