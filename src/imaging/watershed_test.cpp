// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/watershed.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/rng.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/peak_markers.hpp"
#include "imaging/region_merging.hpp"

namespace carpus::imaging {
namespace {

/// A relief without ties (a random permutation of 0..n-1) and some markers.
struct Problem {
  Grid<float> relief;
  Grid<RegionLabel> markers;
  RegionLabel marker_count = 0;
};

Problem random_problem(std::uint64_t seed) {
  Rng rng(seed);
  GridGeometry g;
  g.size = {static_cast<int>(2 + rng.below(8)), static_cast<int>(2 + rng.below(8)),
            static_cast<int>(2 + rng.below(8))};
  Problem p{Grid<float>(g), Grid<RegionLabel>(g), 0};
  const std::size_t n = g.voxel_count();
  std::vector<float> heights(n);
  std::iota(heights.begin(), heights.end(), 0.0F);
  for (std::size_t i = n - 1; i > 0; --i) std::swap(heights[i], heights[rng.below(i + 1)]);
  std::copy(heights.begin(), heights.end(), p.relief.values().begin());
  p.marker_count = static_cast<RegionLabel>(1 + rng.below(4));
  for (RegionLabel m = 1; m <= p.marker_count; ++m) p.markers[rng.below(n)] = m;
  return p;
}

/// One level a height, so that no two voxels of a random problem share one.
WatershedOptions exact_levels(const Problem& p) {
  WatershedOptions options;
  options.levels = static_cast<int>(p.relief.values().size());
  return options;
}

Grid<RegionLabel> flooded(const Problem& p, const WatershedOptions& options) {
  Grid<RegionLabel> labels = p.markers;
  flood_from_markers(p.relief.view(), {}, options, labels.view());
  return labels;
}

/// The neighbours of v, some beyond the grid, by counting the axes that differ.
std::vector<VoxelIndex> around(const VoxelIndex& v, const WatershedOptions& how) {
  std::vector<VoxelIndex> found;
  const int most = how.connectivity == Connectivity::Faces   ? 1
                   : how.connectivity == Connectivity::Edges ? 2
                                                             : 3;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int differing = (x != 0 ? 1 : 0) + (y != 0 ? 1 : 0) + (z != 0 ? 1 : 0);
        if (differing == 0 || differing > most) continue;
        if (how.space == FloodSpace::Slices && z != 0) continue;
        found.push_back({v.x + x, v.y + y, v.z + z});
      }
    }
  }
  return found;
}

constexpr std::array kConnectivities{Connectivity::Faces, Connectivity::Edges,
                                     Connectivity::Corners};

constexpr float kUnreached = 1e9F;

/// Greatest height on the lowest path from the markers of each label to `target`: by Dijkstra on
/// the maximum, the slow and obvious definition.
std::vector<float> pass_heights(const Problem& p, RegionLabel label, const WatershedOptions& how) {
  const GridGeometry& g = p.relief.geometry();
  std::vector<float> best(p.relief.values().size(), kUnreached);
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (p.markers[i] == label) best[i] = -1;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < best.size(); ++i) {
      if (p.markers[i] != 0) continue;
      const VoxelIndex v = g.index_of(i);
      for (const VoxelIndex& n : around(v, how)) {
        if (!g.contains(n)) continue;
        const float through = std::max(best[g.offset_of(n)], p.relief[i]);
        if (through < best[i]) {
          best[i] = through;
          changed = true;
        }
      }
    }
  }
  return best;
}

RC_GTEST_PROP(Watershed, GivesEachVoxelToAMarkerThatReachesItOverTheLowestPass, ()) {
  const Problem p = random_problem(*rc::gen::arbitrary<std::uint64_t>());
  WatershedOptions options = exact_levels(p);
  options.connectivity = *rc::gen::elementOf(kConnectivities);
  options.space = *rc::gen::element(FloodSpace::Volume, FloodSpace::Slices);
  const Grid<RegionLabel> labels = flooded(p, options);
  std::vector<std::vector<float>> heights(p.marker_count + std::size_t{1});
  for (RegionLabel m = 1; m <= p.marker_count; ++m) heights[m] = pass_heights(p, m, options);
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    for (RegionLabel m = 1; m <= p.marker_count; ++m) {
      // A slice without a marker is reached by none.
      RC_ASSERT(labels[i] != 0 || heights[m][i] == kUnreached);
      if (labels[i] != 0) RC_ASSERT(heights[labels[i]][i] <= heights[m][i]);
    }
  }
}

RC_GTEST_PROP(Watershed, TheNamesOfTheMarkersChangeNothing, ()) {
  Problem p = random_problem(*rc::gen::arbitrary<std::uint64_t>());
  WatershedOptions options = exact_levels(p);
  options.connectivity = *rc::gen::elementOf(kConnectivities);
  options.keep_dams = *rc::gen::arbitrary<bool>();
  const Grid<RegionLabel> before = flooded(p, options);
  const auto other_name = [&](RegionLabel m) {
    return m == 0 ? RegionLabel{0} : static_cast<RegionLabel>(100 - m);
  };
  for (RegionLabel& m : p.markers.values()) m = other_name(m);
  const Grid<RegionLabel> after = flooded(p, options);
  for (std::size_t i = 0; i < before.values().size(); ++i) {
    RC_ASSERT(after[i] == other_name(before[i]));
  }
}

TEST(Watershed, TellsHowFarItIsAndCanBeStopped) {
  GridGeometry g;
  g.size = {128, 128, 160};
  Problem p{Grid<float>(g), Grid<RegionLabel>(g), 1};
  p.markers[0] = 1;
  WatershedOptions options;
  std::vector<double> told;
  options.progress = [&](std::string_view, double fraction) { told.push_back(fraction); };
  flooded(p, options);
  ASSERT_GE(told.size(), 2U);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_LE(told.back(), 1.0);
  struct Stopped {};
  options.progress = [](std::string_view, double) { throw Stopped{}; };
  EXPECT_THROW(flooded(p, options), Stopped);
}

RC_GTEST_PROP(Watershed, KeepsMarkersPartitionsTheMaskAndStaysInside, ()) {
  const std::uint64_t seed = *rc::gen::arbitrary<std::uint64_t>();
  const Problem p = random_problem(seed);
  Rng rng(seed + 1);
  std::vector<std::uint8_t> mask(p.relief.values().size());
  for (std::uint8_t& m : mask) m = rng.uniform() < 0.7 ? 1 : 0;
  Grid<RegionLabel> labels = p.markers;
  flood_from_markers(p.relief.view(), mask, {}, labels.view());
  // Reachable = in a component of (mask or marker) that holds a marker.
  Grid<std::uint8_t> space(p.relief.geometry());
  for (std::size_t i = 0; i < mask.size(); ++i) space[i] = mask[i] | (p.markers[i] != 0 ? 1 : 0);
  const Components c = connected_components(space.view());
  std::vector<bool> has_marker(c.voxels.size(), false);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (p.markers[i] != 0) has_marker[c.labels[i]] = true;
  }
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (p.markers[i] != 0) RC_ASSERT(labels[i] == p.markers[i]);
    RC_ASSERT((labels[i] != 0) == (space[i] != 0 && has_marker[c.labels[i]]));
  }
}

RC_GTEST_PROP(Watershed, WithoutTiesIsTheSameInAFlippedVolume, ()) {
  const Problem p = random_problem(*rc::gen::arbitrary<std::uint64_t>());
  const GridGeometry& g = p.relief.geometry();
  const auto flip = [&](std::size_t i) {
    const VoxelIndex v = g.index_of(i);
    return VoxelIndex{g.size[0] - 1 - v.x, g.size[1] - 1 - v.y, g.size[2] - 1 - v.z};
  };
  Problem flipped{Grid<float>(g), Grid<RegionLabel>(g), p.marker_count};
  for (std::size_t i = 0; i < p.relief.values().size(); ++i) {
    flipped.relief[flip(i)] = p.relief[i];
    flipped.markers[flip(i)] = p.markers[i];
  }
  // With walls: a voxel between two basins then belongs to neither, so no order of visiting is
  // left.
  WatershedOptions options = exact_levels(p);
  options.keep_dams = true;
  const Grid<RegionLabel> a = flooded(p, options);
  const Grid<RegionLabel> b = flooded(flipped, options);
  for (std::size_t i = 0; i < a.values().size(); ++i) RC_ASSERT(a[i] == b[flip(i)]);
}

RC_GTEST_PROP(Watershed, DamsKeepBasinsApart, ()) {
  const Problem p = random_problem(*rc::gen::arbitrary<std::uint64_t>());
  WatershedOptions options = exact_levels(p);
  options.keep_dams = true;
  options.connectivity = *rc::gen::elementOf(kConnectivities);
  const Grid<RegionLabel> labels = flooded(p, options);
  const GridGeometry& g = p.relief.geometry();
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    for (const VoxelIndex& n : around(v, options)) {
      if (!g.contains(n) || labels[i] == 0 || labels[n] == 0) continue;
      // Only markers placed side by side may touch.
      if (p.markers[i] != 0 && p.markers[n] != 0) continue;
      RC_ASSERT(labels[i] == labels[n]);
    }
  }
}

RC_GTEST_PROP(Watershed, SliceBySliceNeverCrossesSlices, ()) {
  const Problem p = random_problem(*rc::gen::arbitrary<std::uint64_t>());
  WatershedOptions options = exact_levels(p);
  options.space = FloodSpace::Slices;
  const Grid<RegionLabel> labels = flooded(p, options);
  const GridGeometry& g = p.relief.geometry();
  const std::size_t plane = static_cast<std::size_t>(g.size[0] * g.size[1]);
  for (std::size_t z = 0; z < static_cast<std::size_t>(g.size[2]); ++z) {
    std::vector<bool> present(p.marker_count + std::size_t{1}, false);
    bool any = false;
    for (std::size_t i = z * plane; i < (z + 1) * plane; ++i) {
      present[p.markers[i]] = true;
      any = any || p.markers[i] != 0;
    }
    for (std::size_t i = z * plane; i < (z + 1) * plane; ++i) {
      RC_ASSERT((labels[i] != 0) == any);
      if (any) RC_ASSERT(present[labels[i]]);
    }
  }
}

RC_GTEST_PROP(Watershed, InItsReliefsOwnMemoryIsTheSame, ()) {
  Problem p = random_problem(*rc::gen::arbitrary<std::uint64_t>());
  p.relief[p.relief.values().size() / 2] = std::numeric_limits<float>::infinity();
  const Grid<RegionLabel> expected = flooded(p, {});
  flood_from_markers(std::move(p.relief), {}, p.markers.view());
  RC_ASSERT(
      std::equal(expected.values().begin(), expected.values().end(), p.markers.values().begin()));
}

RC_GTEST_PROP(Watershed, OfDepthsIsThatOfTheReliefUpsideDown, ()) {
  const std::uint64_t seed = *rc::gen::arbitrary<std::uint64_t>();
  const Problem p = random_problem(seed);
  Rng rng(seed + 1);
  Grid<std::uint8_t> mask(p.relief.geometry());
  for (std::uint8_t& m : mask.values()) m = rng.uniform() < 0.7 ? 1 : 0;
  Grid<float> upside_down = p.relief;
  for (float& value : upside_down.values()) value = -value;
  Grid<RegionLabel> expected = p.markers;
  flood_from_markers(upside_down.view(), mask.values(), {}, expected.view());
  Grid<RegionLabel> labels = p.markers;
  flood_depths_from_markers({p.relief.view(), std::as_const(mask).view()}, {}, labels.view());
  RC_ASSERT(
      std::equal(expected.values().begin(), expected.values().end(), labels.values().begin()));
}

TEST(Watershed, MeetsOnTheCrestBetweenTwoValleys) {
  GridGeometry g;
  g.size = {11, 1, 1};
  Problem p{Grid<float>(g, {0, 1, 2, 3, 4, 5, 9, 3, 2, 1, 0}), Grid<RegionLabel>(g), 2};
  p.markers[0] = 1;
  p.markers[10] = 2;
  WatershedOptions options;
  options.keep_dams = true;
  const Grid<RegionLabel> labels = flooded(p, options);
  const std::vector<RegionLabel> expected{1, 1, 1, 1, 1, 1, 0, 2, 2, 2, 2};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), labels.values().begin()));
}

TEST(Watershed, SharesAPlateauByDistance) {
  GridGeometry g;
  g.size = {9, 1, 1};
  Problem p{Grid<float>(g), Grid<RegionLabel>(g), 2};
  p.markers[0] = 1;
  p.markers[8] = 2;
  const Grid<RegionLabel> labels = flooded(p, {});
  EXPECT_EQ(labels[3], 1);
  EXPECT_EQ(labels[5], 2);
}

TEST(ProminentPeaks, AreThoseThatStandOutBySaddleAndHeight) {
  GridGeometry g;
  g.size = {13, 1, 1};
  //                             5 stands out by 5; 4.9 by 0.1 from it; 3 by 2; 0.6 by 0.6
  const Grid<float> height(g, {0, 5, 4.8F, 4.9F, 1, 3, 2.9F, 3, 0, 0.6F, 0, 2, 1});
  const Grid<std::uint8_t> mask(g, 1);
  EXPECT_EQ(prominent_peaks(height.view(), mask.view(), {0.2, 1.0}),
            (std::vector<std::size_t>{1, 5, 11}));
  EXPECT_EQ(prominent_peaks(height.view(), mask.view(), {0.05, 0.5}),
            (std::vector<std::size_t>{1, 3, 5, 7, 11, 9}));
  EXPECT_EQ(prominent_peaks(height.view(), mask.view(), {2.0, 0.0}),
            (std::vector<std::size_t>{1, 5, 11}));
}

/// Whether voxel i is higher than j; of equals the first.
bool is_above(const Grid<float>& height, std::size_t i, std::size_t j) {
  return height[i] != height[j] ? height[i] > height[j] : i < j;
}

/// From where one has to climb down to, to get from voxel i to a higher one; none above the highest
/// of its component.
std::optional<float> saddle_above(const Grid<float>& height,
                                  const Grid<std::uint8_t>& mask,
                                  std::size_t i) {
  std::optional<float> best;
  for (std::size_t t = 0; t < mask.values().size(); ++t) {
    if (mask[t] == 0 || height[t] > height[i] || (best && height[t] <= *best)) continue;
    Grid<std::uint8_t> above(mask.geometry());
    for (std::size_t k = 0; k < above.values().size(); ++k) {
      above[k] = mask[k] != 0 && height[k] >= height[t] ? 1 : 0;
    }
    const Components c = connected_components(above.view());
    for (std::size_t j = 0; j < above.values().size(); ++j) {
      if (c.labels[j] == c.labels[i] && is_above(height, j, i)) best = height[t];
    }
  }
  return best;
}

TEST(ProminentPeaks, AreThoseOfTheDefinition) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    GridGeometry g;
    g.size = {static_cast<int>(1 + rng.below(5)), static_cast<int>(1 + rng.below(5)),
              static_cast<int>(1 + rng.below(5))};
    Grid<float> height(g);
    Grid<std::uint8_t> mask(g);
    // With ties, zeros of both signs, negative and nearly equal heights.
    for (float& h : height.values()) {
      h = static_cast<float>(rng.below(6)) - 2.0F;
      if (rng.below(3) == 0) h = h == 0 ? -0.0F : std::nextafter(h, 100.0F);
    }
    for (std::uint8_t& m : mask.values()) m = rng.uniform() < 0.8 ? 1 : 0;
    constexpr PeakOptions kOptions{1.0, -1.5};
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < mask.values().size(); ++i) {
      if (mask[i] == 0 || static_cast<double>(height[i]) < kOptions.min_height) continue;
      const std::optional<float> saddle = saddle_above(height, mask, i);
      const bool stands_out =
          !saddle ||
          static_cast<double>(height[i]) - static_cast<double>(*saddle) >= kOptions.min_prominence;
      if (stands_out) expected.push_back(i);
    }
    std::sort(expected.begin(), expected.end(),
              [&](std::size_t a, std::size_t b) { return is_above(height, a, b); });
    EXPECT_EQ(prominent_peaks(std::as_const(height).view(), std::as_const(mask).view(), kOptions),
              expected)
        << "seed " << seed;
  }
}

RC_GTEST_PROP(RegionMerging, PartsEachRegionIntoItsComponents, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  GridGeometry g;
  g.size = {static_cast<int>(1 + rng.below(9)), static_cast<int>(1 + rng.below(9)),
            static_cast<int>(1 + rng.below(9))};
  constexpr RegionLabel kMost = 3;
  Grid<RegionLabel> before(g);
  for (RegionLabel& label : before.values()) {
    label = static_cast<RegionLabel>(rng.below(std::size_t{kMost} + 1));
  }
  const std::size_t least = 1 + rng.below(12);
  Grid<RegionLabel> parted = before;
  RegionLabel count = kMost;
  const std::size_t removed = part_components(parted.view(), least, count);
  std::size_t expected_removed = 0;
  RegionLabel new_regions = 0;
  for (RegionLabel region = 1; region <= kMost; ++region) {
    Grid<std::uint8_t> own(g);
    for (std::size_t i = 0; i < own.values().size(); ++i) own[i] = before[i] == region ? 1 : 0;
    const Components c = connected_components(own.view());
    std::vector<RegionLabel> given(c.voxels.size(), 0);
    for (std::size_t i = 0; i < own.values().size(); ++i) {
      const std::uint32_t piece = c.labels[i];
      if (piece == 0) continue;
      const bool is_largest = piece == c.largest();
      const bool is_kept = c.voxels[piece] >= least;
      if (is_largest) RC_ASSERT(parted[i] == region);
      if (!is_largest && is_kept) {
        RC_ASSERT(parted[i] > kMost);
        if (given[piece] == 0) ++new_regions;
        RC_ASSERT(given[piece] == 0 || given[piece] == parted[i]);
        given[piece] = parted[i];
      }
      if (!is_largest && !is_kept) {
        RC_ASSERT(parted[i] == 0);
        ++expected_removed;
      }
    }
  }
  RC_ASSERT(removed == expected_removed);
  RC_ASSERT(count == kMost + new_regions);
}

TEST(RegionMerging, JoinsOverAWideNeckOnly) {
  RegionTable table;
  table.voxels = {0, 1000, 900, 800, 10, 5};
  table.peak = {0, 5, 4, 4, 1, 1};
  table.contacts[{1, 2}] = {20, 3.6F};  // ratio 0.9
  table.contacts[{2, 3}] = {10, 1.0F};  // 0.25
  table.contacts[{3, 4}] = {2, 0.3F};   // small region 4 touches 3 most
  table.contacts[{1, 4}] = {1, 0.2F};
  const auto merged = merge_regions(table, 1.0, {0.6, 100});
  EXPECT_EQ(merged, (std::vector<RegionLabel>{0, 1, 1, 2, 2, 0}));
}

TEST(RegionMerging, KeepsTheLargestPieceOfEachRegion) {
  GridGeometry g;
  g.size = {8, 1, 1};
  Grid<RegionLabel> labels(g, {1, 1, 2, 1, 2, 2, 0, 1});
  EXPECT_EQ(keep_largest_components(labels.view()), 3U);
  const std::vector<RegionLabel> expected{1, 1, 0, 0, 2, 2, 0, 0};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), labels.values().begin()));
}

}  // namespace
}  // namespace carpus::imaging
