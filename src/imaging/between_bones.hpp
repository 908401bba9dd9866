// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which dark voxels lie between two bright bodies, as a joint does.
#pragma once

#include "geometry/grid.hpp"

namespace carpus::imaging {

/// Whether the density rises by `rise` on both sides of voxel `v` within `reach_mm`, in some
/// direction. The layer below a cortex is dark beside a bright sheet too, but rises on one side
/// only: taken for a cleft, it would let what comes in through a crack run round the whole bone.
[[nodiscard]] bool lies_between_bones(const GridView<const float>& image,
                                      const VoxelIndex& v,
                                      double reach_mm,
                                      float rise);

}  // namespace carpus::imaging
