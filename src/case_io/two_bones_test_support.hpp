// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "geometry/mat3.hpp"

namespace carpus::case_io::test {

/// Labels 3 and 9. The axes of a scan held askew; 13 columns are filled up to 16 in the file.
inline Grid<std::uint8_t> two_bones() {
  GridGeometry g;
  g.size = {13, 11, 6};
  g.spacing = {0.3, 0.4, 0.625};
  g.origin = {-12.5, 3.25, 140};
  const double c = std::cos(0.2);
  const double s = std::sin(0.2);
  g.direction = Mat3::from_columns({c, s, 0}, {-s, c, 0}, {0, 0, 1});
  Grid<std::uint8_t> labels(g);
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (v.x < 5 && v.y > 3 && v.z < 4) labels[i] = 3;
    if (v.x > 7 && v.y + v.z > 6 && v.z > 1) labels[i] = 9;
  }
  return labels;
}

}  // namespace carpus::case_io::test
