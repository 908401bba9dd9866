// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Exact Euclidean distance on an anisotropic grid. Source: [felzenszwalb2012distance].
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"

namespace carpus::imaging {

/// Distance [mm] from each voxel centre to the nearest voxel centre where `mask` is 0; 0 at those
/// themselves. What lies beyond the volume counts as unknown, not as 0, so a bone cut by the field
/// of view is as deep at the cut as inside. Infinite everywhere if no voxel is 0. O(n).
[[nodiscard]] Grid<float> distance_to_background(const GridView<const std::uint8_t>& mask);

/// The same to the nearest voxel centre where `mask` is `target`.
[[nodiscard]] Grid<float> distance_to_value(const GridView<const std::uint8_t>& mask,
                                            std::uint8_t target);

}  // namespace carpus::imaging
