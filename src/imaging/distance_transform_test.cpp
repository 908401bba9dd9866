// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/distance_transform.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "core/rng.hpp"

namespace carpus::imaging {
namespace {

float brute_force(const Grid<std::uint8_t>& mask, const VoxelIndex& a) {
  double best = std::numeric_limits<double>::infinity();
  const GridGeometry& g = mask.geometry();
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    if (mask[i] != 0) continue;
    const VoxelIndex b = g.index_of(i);
    best = std::min(best, length({(a.x - b.x) * g.spacing.x, (a.y - b.y) * g.spacing.y,
                                  (a.z - b.z) * g.spacing.z}));
  }
  return static_cast<float>(best);
}

RC_GTEST_PROP(DistanceTransform, EqualsBruteForceOnAnisotropicGrids, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  GridGeometry g;
  g.size = {static_cast<int>(1 + rng.below(9)), static_cast<int>(1 + rng.below(9)),
            static_cast<int>(1 + rng.below(9))};
  g.spacing = {rng.uniform(0.1, 2), rng.uniform(0.1, 2), rng.uniform(0.1, 2)};
  const double density = rng.uniform(0.3, 1.0);
  Grid<std::uint8_t> mask(g);
  for (std::uint8_t& m : mask.values()) m = rng.uniform() < density ? 1 : 0;
  const Grid<float> d = distance_to_background(mask.view());
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    const float expected = brute_force(mask, g.index_of(i));
    if (std::isinf(expected)) {
      RC_ASSERT(std::isinf(d[i]));
    } else {
      RC_ASSERT(std::abs(d[i] - expected) <= 1e-5F * (1 + expected));
    }
  }
}

TEST(DistanceTransform, TakesNothingBeyondTheVolumeForBackground) {
  GridGeometry g;
  g.size = {5, 5, 20};
  Grid<std::uint8_t> mask(g, 1);
  for (int y = 0; y < 5; ++y) {
    for (int z = 0; z < 20; ++z) mask[VoxelIndex{0, y, z}] = 0;
  }
  const Grid<float> d = distance_to_background(mask.view());
  EXPECT_EQ((d[VoxelIndex{4, 2, 0}]), 4.0F);
  EXPECT_EQ((d[VoxelIndex{4, 2, 10}]), 4.0F);
}

}  // namespace
}  // namespace carpus::imaging
