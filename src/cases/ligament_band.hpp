// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A ligament between two bones as a scope sees it on a joint's wall: a grid of places, which yields
// (arthroscopy/band_net.hpp). Frame Patient as scanned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::cases {

struct LigamentBand {
  std::string id;           ///< of the finding that it is told as: "scapholunate"
  std::uint8_t joint = 0;   ///< in ArthroscopicMap::joints
  std::uint8_t first = 0;   ///< body that its fibres come from ...
  std::uint8_t second = 0;  ///< ... and go to
  /// Fibres side by side, and places along each.
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<Vec3> at;       ///< row by row, in its middle: half its thickness under the wall [mm]
  std::vector<Vec3> inwards;  ///< unit, into the joint
  double thickness_mm = 0;
  double along_n_per_mm = 0;  ///< of its fibres together
};

/// Most that a joint's wall has: what the tick keeps room for.
inline constexpr std::size_t kMaxBands = 2;

}  // namespace carpus::cases
