// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/planar_hull_steps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "hull/planar_hull.hpp"

namespace carpus::figures {
namespace {

std::vector<Vec2> cloud(std::uint64_t seed, int count) {
  Rng rng(seed);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) points.push_back({20 * rng.normal(), 12 * rng.normal()});
  return points;
}

TEST(PlanarHullSteps, QuickhullsRoundsEndAtTheHullThatAllAlgorithmsFind) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const std::vector<Vec2> points = cloud(seed, 90);
    const auto rounds = quickhull_rounds(points);
    ASSERT_GE(rounds.size(), 3U);
    for (std::size_t i = 1; i < rounds.size(); ++i) {
      EXPECT_GT(rounds[i].size(), rounds[i - 1].size());
    }
    auto found = rounds.back();
    auto hull = hull::build_planar_hull(points, hull::PlanarAlgorithm::Fast).corners;
    std::sort(found.begin(), found.end());
    std::sort(hull.begin(), hull.end());
    EXPECT_TRUE(std::equal(found.begin(), found.end(), hull.begin(), hull.end())) << seed;
  }
}

TEST(PlanarHullSteps, EveryMomentIsNamed) {
  const std::vector<Vec2> points = cloud(3, 60);
  const std::size_t h = hull::build_planar_hull(points, hull::PlanarAlgorithm::Fast).corners.size();
  EXPECT_THAT(draw_gift_wrapping(points), testing::HasSubstr("edge 1 of " + std::to_string(h)));
  EXPECT_THAT(draw_quickhull(points), testing::HasSubstr(", 0 points still outside"));
  EXPECT_THAT(draw_chan(points, 12), testing::HasSubstr("groups of 12 points"));
}

TEST(PlanarHullSteps, PointsOnOneLineAreRefused) {
  const std::vector<Vec2> line{{0, 0}, {1, 1}, {2, 2}, {5, 5}};
  EXPECT_THROW((void)draw_gift_wrapping(line), InvalidInput);
  EXPECT_THROW((void)quickhull_rounds(line), InvalidInput);
  EXPECT_THROW((void)draw_chan(line, 2), InvalidInput);
}

}  // namespace
}  // namespace carpus::figures
