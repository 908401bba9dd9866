// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/cube_cases.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

namespace carpus::figures {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::Le;
using testing::ResultOf;

TEST(CubeCases, AreTheFifteenOfThePrintedFigure) {
  const auto bases = base_cube_cases();
  EXPECT_EQ(bases.size(), 15U);
  EXPECT_THAT(bases, Each(ResultOf([](std::uint8_t b) { return std::popcount(b); }, Le(4))));
  // None, one corner, an edge, a face's and the space's diagonal, then three and four corners.
  std::vector<int> counts(5, 0);
  for (const std::uint8_t b : bases) ++counts[static_cast<std::size_t>(std::popcount(b))];
  EXPECT_THAT(counts, ElementsAre(1, 1, 3, 3, 7));
}

TEST(CubeCases, EachIsDrawnWithItsInsideCornersAndItsTriangles) {
  const std::string svg = draw_cube_cases();
  std::size_t corners = 0;
  for (const std::uint8_t b : base_cube_cases()) {
    corners += static_cast<std::size_t>(std::popcount(b));
  }
  std::size_t dots = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    ++dots;
  }
  EXPECT_EQ(dots, corners);
  EXPECT_THAT(svg, testing::HasSubstr(">14</text>"));
}

}  // namespace
}  // namespace carpus::figures
