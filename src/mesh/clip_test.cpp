// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/clip.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace carpus::mesh {
namespace {

/// Unit square of two facets at z = 0, facing +z.
const TriangleMesh kSquare{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};

TEST(Clip, CutsAStraightEdgeAndKeepsTheSideOfTheNormal) {
  const TriangleMesh right = clipped(kSquare, {0.25, 0, 0}, {2, 0, 0});
  EXPECT_NEAR(area_of(right), 0.75, 1e-12);
  EXPECT_NEAR(area_of(clipped(kSquare, {0.25, 0, 0}, {-1, 0, 0})), 0.25, 1e-12);
  double least = 1;
  for (const Vec3& v : right.vertices) least = std::min(least, v.x);
  EXPECT_NEAR(least, 0.25, 1e-12);
  for (const auto& [a, b, c] : right.facets) {
    const Vec3& p = right.vertices[a];
    EXPECT_GT(cross(right.vertices[b] - p, right.vertices[c] - p).z, 0) << "still faces +z";
  }
}

TEST(Clip, NeighboursShareTheCutOfTheirEdge) {
  // Across the diagonal: its cut belongs to both facets, the other two cuts to one each.
  const TriangleMesh half = clipped(kSquare, {0, 0.5, 0}, {0, 1, 0});
  EXPECT_EQ(half.vertices.size(), 2U + 3U);
}

TEST(Clip, KeepsAllOrNothingOfWhatThePlaneDoesNotMeet) {
  const TriangleMesh all = clipped(kSquare, {-1, 0, 0}, {1, 0, 0});
  EXPECT_EQ(all.facets, kSquare.facets);
  EXPECT_EQ(all.vertices, kSquare.vertices);
  const TriangleMesh none = clipped(kSquare, {2, 0, 0}, {1, 0, 0});
  EXPECT_TRUE(none.facets.empty());
  EXPECT_TRUE(none.vertices.empty());
}

TEST(Clip, FacetsThatOnlyTouchThePlaneAreKeptWhole) {
  EXPECT_EQ(clipped(kSquare, {0, 0, 0}, {1, 0, 0}).facets.size(), 2U);
  EXPECT_EQ(clipped(kSquare, {0, 0, 0}, {0, 0, 1}).facets.size(), 2U) << "all of it in the plane";
}

}  // namespace
}  // namespace carpus::mesh
