// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/hull_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "hull/fast_hull.hpp"

namespace carpus::figures {
namespace {

std::vector<Vec3> cube() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back({10.0 * (i & 1), 10.0 * (i >> 1 & 1), 10.0 * (i >> 2)});
  }
  return points;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(HullPicture, ShowsTheHullOverTheObject) {
  const auto hull = hull::build_fast_hull(cube());
  const std::string cloud = draw_hull({cube(), {}}, hull.polytope);
  const std::string solid = draw_hull(hull.polytope.surface(), hull.polytope);
  // Of a cube seen aslant: six triangles of the object, then three faces of the hull.
  EXPECT_EQ(count(solid, "<path fill=\"#"), 6U + 3U);
  EXPECT_EQ(count(cloud, "<path fill=\"#"), 3U);
  EXPECT_LT(solid.find("fill-opacity=\"1\""), solid.find("fill-opacity=\"0.22\""));
  EXPECT_EQ(count(cloud, "h0"), 8U);  // its points
}

TEST(HullPicture, ShowsPointsInThePlaneWithinTheirHull) {
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 2}, {0, 2}, {2, 1}};
  const std::string picture = draw_planar_hull(points, std::vector<std::uint32_t>{0, 1, 2, 3});
  EXPECT_THAT(picture, testing::HasSubstr("M450 450h0"));  // the inner point, in the middle
  EXPECT_THAT(picture, testing::HasSubstr("M40.0 655.0L860.0 655.0L860.0 245.0L40.0 245.0Z"));
}

}  // namespace
}  // namespace carpus::figures
