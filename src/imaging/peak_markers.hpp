// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Markers for the watershed without clicks: the peaks of a height field that stand out.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"
#include "imaging/masked_values.hpp"

namespace carpus::imaging {

struct PeakOptions {
  double min_prominence = 0;  ///< height above the highest saddle to a higher peak
  double min_height = 0;      ///< lower peaks are ignored
};

/// Positions in memory of the peaks of `height` within its mask (6 neighbours) whose prominence and
/// height suffice, highest first, ties by position. Each component of the mask that reaches
/// min_height has at least one. The same peaks as h-maxima by grey reconstruction
/// [vincent1993morphological], found in one sweep from high to low with a union-find of basins.
[[nodiscard]] std::vector<std::size_t> prominent_peaks(const MaskedValues& height,
                                                       const PeakOptions& options);
[[nodiscard]] std::vector<std::size_t> prominent_peaks(const GridView<const float>& height,
                                                       const GridView<const std::uint8_t>& mask,
                                                       const PeakOptions& options);

}  // namespace carpus::imaging
