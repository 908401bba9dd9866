// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Takes a scan apart into bones and the soft tissue around them, so that they can be put together
// again at other poses: no voxel's attenuation is lost, and none counts twice.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fluoroscopy/attenuation_volume.hpp"
#include "geometry/grid.hpp"

namespace carpus::fluoroscopy {

/// How far from a body's voxels its blurred edge still counts as its own [mm]: whole up to
/// kRimCoreMm, fading to nothing at kRimMm. A clinical CT blurs an edge by a deviation of 0.4 to
/// 0.7 mm.
inline constexpr double kRimCoreMm = 0.9;
inline constexpr double kRimMm = 1.8;

/// A body by itself, on a part of the scan's grid.
struct BodyPart {
  IndexBox box;              ///< voxels of the scan; empty for a body without any
  Grid<std::int16_t> units;  ///< attenuation above the soft tissue that would be in its place;
                             ///< negative in fatty marrow
};

struct TissueSplit {
  Grid<std::int16_t> soft;       ///< the scan with every body filled by the soft tissue beside it
  std::vector<BodyPart> bodies;  ///< in the order of the labels given
};

/// soft + bodies is the scan, voxel by voxel, to the unit (kAttenuationUnitPerMm).
/// @param ct  HU.
/// @param labels  same size as ct.
/// @param body_labels  the value in `labels` of each body; other values are soft tissue.
/// @throws InvalidInput where sizes differ or a label comes twice.
[[nodiscard]] TissueSplit split_tissue(const GridView<const std::int16_t>& ct,
                                       const GridView<const std::uint8_t>& labels,
                                       std::span<const std::uint8_t> body_labels);

}  // namespace carpus::fluoroscopy
