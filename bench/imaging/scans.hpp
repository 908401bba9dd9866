// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulated scans of any size: round bones with cortex and marrow in soft tissue, blurred, noisy.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/imaging/volume.hpp"

namespace carpus::bench {

struct Scan {
  std::string name;
  Volume volume;
  /// As `reconstruct` sets them: the inner part of each bone, and all that lies beyond bone.
  std::vector<std::uint16_t> dense;
  /// As a person sets them: a small ball in each bone, and one in a corner.
  std::vector<std::uint16_t> sparse;
};

/// @param size  voxels of 0.3 mm.
[[nodiscard]] Scan make_scan(const std::array<int, 3>& size, std::uint64_t seed);

}  // namespace carpus::bench
