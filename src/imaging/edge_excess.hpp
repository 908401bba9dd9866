// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a bone's edge lies in the CT: half-way between soft tissue and the cortex near it.
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"
#include "imaging/bone_markers.hpp"

namespace carpus::imaging {

/// Median density of soft tissue outside `mask` [HU]; muscle's usual one where none is seen.
[[nodiscard]] float median_soft_tissue(const GridView<const float>& smoothed_hu,
                                       const GridView<const std::uint8_t>& mask);

/// How far each voxel is above the half-maximum of the cortex near it, as a part of that cortex:
/// 0 on a bone's edge, < 0 outside it. Known where `mask` is near.
///
/// A cortex thinner than the blur does not reach its own density, and half of what is left of it
/// lies outside the bone (by about 0.1 mm). There the edge is put at half of what the scan's thick
/// cortex reaches, but at no more than thin_rim_fraction of the thin one: how thin it is is not
/// known.
[[nodiscard]] Grid<float> measure_edge_excess(const GridView<const float>& smoothed_hu,
                                              const GridView<const std::uint8_t>& mask,
                                              float soft_tissue_hu,
                                              const BoneSegmentationOptions& options);

}  // namespace carpus::imaging
