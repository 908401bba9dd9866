// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The watershed let in again from what a person painted: see mend_bones.hpp.
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"
#include "imaging/bone_markers.hpp"

namespace carpus::reconstruct {

/// @param hu  the CT of a box, and `smoothed`, the same with smoothing_sigma_mm
/// @param before  labels before the paint, and `painted` after it, on the same box
/// @return labels of the box: of what was painted, of the bones that this touched, and of all
///     others, which are as they were
[[nodiscard]] Grid<std::uint8_t> grow_paint(const Grid<std::int16_t>& hu,
                                            const Grid<float>& smoothed,
                                            const Grid<std::uint8_t>& before,
                                            const Grid<std::uint8_t>& painted,
                                            const imaging::BoneSegmentationOptions& options);

}  // namespace carpus::reconstruct
