// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Watershed from markers: water rises over a relief from the markers only, and where two basins
// meet they stay apart. For given markers the result is unique. Sources:
// [beucher1992morphological], [meyer1994topographic]; thesis §3.2 [yaacoub2008].
#pragma once

#include <cstdint>
#include <span>

#include "core/progress.hpp"
#include "geometry/grid.hpp"
#include "imaging/masked_values.hpp"
#include "imaging/neighbourhood.hpp"

namespace carpus::imaging {

/// Region numbers; 0 = none.
using RegionLabel = std::uint16_t;

/// The finest that a relief can be quantised to.
inline constexpr int kMostLevels = 8192;

struct WatershedOptions {
  FloodSpace space = FloodSpace::Volume;  ///< Slices: each slice for itself, as in the thesis
  Connectivity connectivity = Connectivity::Faces;  ///< what water flows through
  /// Leave a wall of label 0, one voxel thick, where basins meet (the thesis's form); otherwise
  /// such voxels belong to the basin that reached them first.
  bool keep_dams = false;
  /// The relief is quantised to this many levels between its least and greatest finite value;
  /// first-in-first-out within one level. At most kMostLevels.
  int levels = 4096;
  /// Told now and then; what it throws ends the flood, and labels stay as they were.
  Progress progress = no_progress;
};

/// Floods `relief` from the voxels of `labels` that are not 0, which keep their label, until no
/// unlabelled voxel touches a basin. Only voxels where `mask` is not 0 are flooded (empty = all).
/// A relief that is not finite counts as the highest level. Deterministic; O(n + levels).
void flood_from_markers(const GridView<const float>& relief,
                        std::span<const std::uint8_t> mask,
                        const WatershedOptions& options,
                        const GridView<RegionLabel>& labels);

/// The same on all of the grid, in the memory of `relief`, which is used up.
void flood_from_markers(Grid<float> relief,
                        const WatershedOptions& options,
                        const GridView<RegionLabel>& labels);

/// The same within the mask of `depth`, from the deepest places upwards.
void flood_depths_from_markers(const MaskedValues& depth,
                               const WatershedOptions& options,
                               const GridView<RegionLabel>& labels);

}  // namespace carpus::imaging
