// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether basins are right, for any engine: each voxel must be reached from a marker of its own
// label, over voxels of that label, without rising higher than the lowest way from any marker.
// Engines share plateaus in their own ways; by this measure all of them may be right.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace carpus::bench {

struct BasinCheck {
  std::size_t wrong = 0;  ///< voxels without a label, with a marker's changed, or too high
  std::size_t other = 0;  ///< voxels whose label differs from the reference's
};

/// @param levels  the relief, below 4096; x runs fastest.
/// @param reference  labels to count differences from.
[[nodiscard]] BasinCheck check_basins(const std::array<int, 3>& size,
                                      std::span<const std::uint16_t> levels,
                                      std::span<const std::uint16_t> markers,
                                      std::span<const std::uint16_t> labels,
                                      std::span<const std::uint16_t> reference);

}  // namespace carpus::bench
