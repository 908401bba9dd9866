// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/binary_mask.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <vector>

#include "core/rng.hpp"
#include "imaging/box_maximum.hpp"

namespace carpus::imaging {
namespace {

Grid<std::uint8_t> random_mask(Rng& rng) {
  GridGeometry g;
  g.size = {static_cast<int>(1 + rng.below(10)), static_cast<int>(1 + rng.below(10)),
            static_cast<int>(1 + rng.below(10))};
  Grid<std::uint8_t> mask(g);
  const double density = rng.uniform(0.1, 0.9);
  for (std::uint8_t& m : mask.values()) m = rng.uniform() < density ? 1 : 0;
  return mask;
}

/// Number of the six neighbours inside the volume for which `test` holds.
template <typename Test>
int count_neighbours(const GridGeometry& g, const VoxelIndex& v, const Test& test) {
  int count = 0;
  for (const VoxelIndex& n : {VoxelIndex{v.x - 1, v.y, v.z}, VoxelIndex{v.x + 1, v.y, v.z},
                              VoxelIndex{v.x, v.y - 1, v.z}, VoxelIndex{v.x, v.y + 1, v.z},
                              VoxelIndex{v.x, v.y, v.z - 1}, VoxelIndex{v.x, v.y, v.z + 1}}) {
    count += g.contains(n) && test(n) ? 1 : 0;
  }
  return count;
}

RC_GTEST_PROP(ConnectedComponents, PartitionTheMaskAndNeverTouchEachOther, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const Grid<std::uint8_t> mask = random_mask(rng);
  const Components c = connected_components(mask.view());
  std::vector<std::size_t> counted(c.voxels.size(), 0);
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    RC_ASSERT((c.labels[i] != 0) == (mask[i] != 0));
    if (mask[i] == 0) continue;
    ++counted[c.labels[i]];
    const int foreign = count_neighbours(mask.geometry(), mask.geometry().index_of(i), [&](auto n) {
      return mask[n] != 0 && c.labels[n] != c.labels[i];
    });
    RC_ASSERT(foreign == 0);
  }
  RC_ASSERT(counted == c.voxels);
}

RC_GTEST_PROP(ConnectedComponents, EachIsConnected, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const Grid<std::uint8_t> mask = random_mask(rng);
  const GridGeometry& g = mask.geometry();
  const Components c = connected_components(mask.view());
  std::vector<bool> seen(mask.values().size(), false);
  std::vector<bool> label_started(c.voxels.size(), false);
  for (std::size_t seed = 0; seed < seen.size(); ++seed) {
    if (mask[seed] == 0 || seen[seed]) continue;
    RC_ASSERT(!label_started[c.labels[seed]]);
    label_started[c.labels[seed]] = true;
    std::vector<VoxelIndex> stack{g.index_of(seed)};
    seen[seed] = true;
    while (!stack.empty()) {
      const VoxelIndex v = stack.back();
      stack.pop_back();
      count_neighbours(g, v, [&](const VoxelIndex& n) {
        if (mask[n] == 0 || seen[g.offset_of(n)]) return false;
        seen[g.offset_of(n)] = true;
        stack.push_back(n);
        return true;
      });
    }
  }
}

RC_GTEST_PROP(Opening, RemovesOnlyAndIsIdempotent, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const Grid<std::uint8_t> mask = random_mask(rng);
  const Grid<std::uint8_t> once = opened_by_one_voxel(mask.view());
  const Grid<std::uint8_t> twice = opened_by_one_voxel(once.view());
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    RC_ASSERT(once[i] <= mask[i]);
    RC_ASSERT(once[i] == twice[i]);
  }
}

TEST(Opening, CutsABridgeOneVoxelThick) {
  GridGeometry g;
  g.size = {15, 5, 5};
  Grid<std::uint8_t> mask(g);
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    mask[i] = v.x < 5 || v.x > 9 || (v.y == 2 && v.z == 2) ? 1 : 0;
  }
  EXPECT_EQ(connected_components(mask.view()).voxels.size(), 2U);
  EXPECT_EQ(connected_components(opened_by_one_voxel(mask.view()).view()).voxels.size(), 3U);
}

TEST(BoxAbove, HoldsWhatIsDenseWithItsMarginAndStaysInTheVolume) {
  GridGeometry g;
  g.size = {20, 20, 20};
  g.spacing = {0.5, 1, 2};
  Grid<float> image(g);
  EXPECT_FALSE(box_above(image.view(), 400, 4).has_value());
  image[VoxelIndex{10, 10, 1}] = 500;
  const auto box = box_above(image.view(), 400, 4);
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ(box->low, (VoxelIndex{2, 6, 0}));
  EXPECT_EQ(box->high, (VoxelIndex{18, 14, 3}));
  const Grid<float> part = crop(GridView<const float>(image.view()), *box);
  EXPECT_EQ((part[VoxelIndex{8, 4, 1}]), 500.0F);
  EXPECT_EQ(part.geometry().patient_from_voxel({8, 4, 1}), g.patient_from_voxel({10, 10, 1}));
}

RC_GTEST_PROP(BoxMaximum, EqualsBruteForce, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  GridGeometry g;
  g.size = {static_cast<int>(1 + rng.below(9)), static_cast<int>(1 + rng.below(9)),
            static_cast<int>(1 + rng.below(9))};
  g.spacing = {0.5, 1.0, 2.0};
  Grid<float> image(g);
  for (float& v : image.values()) v = static_cast<float>(rng.uniform());
  const Grid<float> result = box_maximum(image, 2.0);  // 4, 2 and 1 voxels
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    float expected = 0;
    for (std::size_t j = 0; j < image.values().size(); ++j) {
      const VoxelIndex w = g.index_of(j);
      if (std::abs(v.x - w.x) <= 4 && std::abs(v.y - w.y) <= 2 && std::abs(v.z - w.z) <= 1) {
        expected = std::max(expected, image[j]);
      }
    }
    RC_ASSERT(result[i] == expected);
  }
}

}  // namespace
}  // namespace carpus::imaging
