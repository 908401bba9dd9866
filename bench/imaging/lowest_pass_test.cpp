// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/imaging/lowest_pass.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/rng.hpp"
#include "imaging/watershed.hpp"

namespace carpus::bench {
namespace {

using Values = std::vector<std::uint16_t>;

TEST(LowestPass, CallsBasinsWrongThatCrossACrest) {
  const std::array<int, 3> size{7, 1, 1};
  const Values levels{0, 1, 2, 9, 2, 1, 0};
  const Values markers{1, 0, 0, 0, 0, 0, 2};
  const auto wrong = [&](const Values& labels) {
    return check_basins(size, levels, markers, labels, labels).wrong;
  };
  EXPECT_EQ(wrong({1, 1, 1, 1, 2, 2, 2}), 0U);
  EXPECT_EQ(wrong({1, 1, 1, 2, 2, 2, 2}), 0U);  // the crest may be either's
  EXPECT_EQ(wrong({1, 1, 1, 1, 1, 2, 2}), 1U);  // over the crest
  EXPECT_EQ(wrong({1, 1, 1, 0, 2, 2, 2}), 1U);  // nobody's
  EXPECT_EQ(wrong({1, 2, 1, 1, 2, 2, 2}), 3U);  // cut off from their markers
  EXPECT_EQ(wrong({2, 1, 1, 1, 2, 2, 2}), 1U + 3U);
  const Values one{1, 1, 1, 1, 2, 2, 2};
  const Values other{1, 1, 1, 2, 2, 2, 2};
  EXPECT_EQ(check_basins(size, levels, markers, one, other).other, 1U);
}

TEST(LowestPass, PassesOurOwnFloodOnPlateaus) {
  Rng rng(3);
  GridGeometry g;
  g.size = {13, 9, 11};
  Grid<float> relief(g);
  Values levels(relief.values().size());
  Grid<std::uint16_t> labels(g);
  levels[0] = 0;
  levels[1] = 4095;  // so that our flood's levels are these
  for (std::size_t i = 2; i < levels.size(); ++i) {
    levels[i] = static_cast<std::uint16_t>(1000 * rng.below(4));
  }
  for (std::size_t i = 0; i < levels.size(); ++i) relief[i] = levels[i];
  for (std::uint16_t m = 1; m <= 5; ++m) labels[2 + rng.below(levels.size() - 2)] = m;
  const Values markers(labels.values().begin(), labels.values().end());
  imaging::flood_from_markers(relief.view(), {}, {}, labels.view());
  EXPECT_EQ(check_basins(g.size, levels, markers, labels.values(), labels.values()).wrong, 0U);
}

}  // namespace
}  // namespace carpus::bench
