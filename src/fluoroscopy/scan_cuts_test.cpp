// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/scan_cuts.hpp"

#include <gtest/gtest.h>

namespace carpus::fluoroscopy {
namespace {

TEST(ScanCuts, AreWhereALimbReachesTheScansBorder) {
  GridGeometry geometry;
  geometry.size = {20, 20, 20};
  Grid<std::int16_t> ct(geometry, -1000);
  for (int z = 0; z < 20; ++z) {
    for (int y = 5; y < 15; ++y) {
      for (int x = 5; x < 15; ++x) ct[VoxelIndex{x, y, z}] = 40;
    }
  }
  const std::vector<ScanCut> cuts = find_scan_cuts(ct.view());
  ASSERT_EQ(cuts.size(), 2U);
  EXPECT_TRUE(cuts[0].axis == 2 && !cuts[0].is_high_end);
  EXPECT_TRUE(cuts[1].axis == 2 && cuts[1].is_high_end);
  EXPECT_LT(distance(cuts[1].centre_mm, {9.5, 9.5, 19}), 1e-12);
  EXPECT_TRUE(is_covered(cuts, {10, 10, 1}) && is_covered(cuts, {10, 10, 18}));
  EXPECT_FALSE(is_covered(cuts, {-100, 10, 10}) || is_covered(cuts, {10, 100, 10}));
}

}  // namespace
}  // namespace carpus::fluoroscopy
