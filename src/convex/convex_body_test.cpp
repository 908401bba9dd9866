// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/convex_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "hull/quickhull.hpp"

namespace carpus::convex {
namespace {

ConvexBody box(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                       (i & 4) != 0 ? half.z : -half.z});
  }
  return ConvexBody(hull::build_convex_hull(corners).polytope);
}

TEST(ConvexBody, MergesTheTrianglesOfABoxIntoSixFaces) {
  const ConvexBody body = box({1, 2, 3});
  EXPECT_EQ(body.faces().size(), 6U);
  for (std::uint32_t v = 0; v < 8; ++v) EXPECT_EQ(body.vertex_neighbours(v).size(), 3U);
  EXPECT_NEAR(length(body.interior_point()), 0, 1e-15);
  EXPECT_NEAR(body.radius_mm(), std::sqrt(14.0), 1e-14);
}

TEST(ConvexBody, GoesCounterClockwiseAboutEachVertex) {
  const ConvexBody body = box({1, 2, 3});
  for (std::uint32_t v = 0; v < 8; ++v) {
    const auto ends = body.vertex_neighbours(v);
    const auto faces = body.vertex_faces(v);
    const Vec3 outward = body.vertices()[v] - body.interior_point();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const std::uint32_t next = ends[(i + 1) % ends.size()];
      const auto& corners = body.faces()[faces[i]].corners;
      EXPECT_NE(std::find(corners.begin(), corners.end(), v), corners.end());
      EXPECT_NE(std::find(corners.begin(), corners.end(), ends[i]), corners.end());
      EXPECT_NE(std::find(corners.begin(), corners.end(), next), corners.end());
      EXPECT_GT(dot(cross(body.vertices()[ends[i]] - body.vertices()[v],
                          body.vertices()[next] - body.vertices()[v]),
                    outward),
                0);
    }
  }
}

struct CornerCount {
  explicit CornerCount(const ConvexBody& body) : count(body.vertices().size()) {}
  std::size_t count;
};
struct FaceCount {
  explicit FaceCount(const ConvexBody& body) : count(body.faces().size()) {}
  std::size_t count;
};

TEST(ConvexBody, MakesWhatMethodsDeriveFromItOnce) {
  const ConvexBody body = box({1, 2, 3});
  EXPECT_EQ(body.derived<CornerCount>().count, 8U);
  EXPECT_EQ(body.derived<FaceCount>().count, 6U);
  EXPECT_EQ(&body.derived<CornerCount>(), &body.derived<CornerCount>());
}

TEST(ConvexBody, HasAFiniteMiddleWhereItsMomentsLeaveTheDoubles) {
  const ConvexBody body(hull::build_convex_hull(
                            std::vector<Vec3>{{0, 0, 0}, {1e99, 0, 0}, {0, 1e99, 0}, {0, 0, 1e99}})
                            .polytope);
  EXPECT_TRUE(is_finite(body.interior_point()));
  EXPECT_GT(body.interior_point().x, 0);
  EXPECT_LT(body.radius_mm(), 1e99);
}

TEST(ConvexBody, RefusesWhatIsNoBody) { EXPECT_THROW(ConvexBody{ConvexPolytope{}}, InvalidInput); }

}  // namespace
}  // namespace carpus::convex
