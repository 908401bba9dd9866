// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/features/voronoi_features.hpp"

#include <gtest/gtest.h>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"
#include "convex/features/placement.hpp"
#include "convex/features/regions.hpp"

namespace carpus::convex {
namespace {

TEST(VoronoiFeatures, NameEachEdgeAlikeFromItsVertexAndFromItsFaces) {
  Rng rng(1);
  for (int sample = 0; sample < 30; ++sample) {
    const VoronoiFeatures features(test::random_body(rng));
    std::size_t spokes = 0;
    for (std::uint32_t v = 0; v < features.vertex_count(); ++v) {
      for (std::size_t i = 0; i < features.spokes(v).size(); ++i, ++spokes) {
        const Feature edge = features.spoke_edge(v, i);
        bool found = false;
        for (std::size_t k = 0; k < features.sides(edge.left).size(); ++k) {
          found = found || features.side_edge(edge.left, k) == edge;
        }
        EXPECT_TRUE(found);
      }
    }
    EXPECT_EQ(features.vertex_count() + features.face_count(), spokes / 2 + 2);  // Euler
  }
}

/// A vertex in the middle of an edge but for rounding leaves a face without area whose normal is
/// that of no sum in doubles.
TEST(VoronoiFeatures, OfSliversKnowTheirNormals) {
  Rng rng(5);
  int slivers = 0;
  for (int sample = 0; sample < 60; ++sample) {
    const ConvexBody body = test::random_body(rng);
    std::vector<Vec3> points(body.vertices().begin(), body.vertices().end());
    for (std::uint32_t v = 0; v < body.vertices().size(); ++v) {
      for (const std::uint32_t w : body.vertex_neighbours(v)) {
        if (v < w) points.push_back((body.vertices()[v] + body.vertices()[w]) * 0.5);
      }
    }
    const ConvexBody finer(hull::build_convex_hull(points).polytope);
    const VoronoiFeatures features(finer);
    for (std::uint32_t f = 0; f < features.face_count(); ++f) {
      const auto sides = features.sides(f);
      const Vec3 origin = features.vertex(sides[0].corner);
      Vec3 area;
      for (std::size_t i = 2; i < sides.size(); ++i) {
        area += cross(features.vertex(sides[i - 1].corner) - origin,
                      features.vertex(sides[i].corner) - origin);
      }
      if (length(area) < 1e-13) ++slivers;
      for (const Vec3& v : features.vertices()) {
        EXPECT_LT(features.plane(f).signed_distance(v), 1e-12 * features.radius_mm());
      }
    }
  }
  EXPECT_GT(slivers, 100);
}

/// Around a body every point lies in a region, and in one only unless it is on a border.
TEST(VoronoiFeatures, RegionsFillTheOutsideOnce) {
  Rng rng(2);
  for (int sample = 0; sample < 40; ++sample) {
    const VoronoiFeatures features(test::random_body(rng));
    const FixedBody body{&features};
    for (int point = 0; point < 40; ++point) {
      const Vec3 p = features.interior_point() + test::random_vector(rng) * 12.0;
      bool outside = false;
      for (const Plane& plane : features.planes()) {
        outside = outside || plane.signed_distance(p) > 1e-6;
      }
      if (!outside) continue;
      int regions = 0;
      for (std::uint32_t v = 0; v < features.vertex_count(); ++v) {
        regions += !leave_vertex(body, v, p - features.vertex(v)) ? 1 : 0;
        for (std::size_t i = 0; i < features.spokes(v).size(); ++i) {
          const Feature edge = features.spoke_edge(v, i);
          if (edge.id > edge.head) continue;
          regions += !leave_edge(region_of_edge(body, edge), edge, p) ? 1 : 0;
        }
      }
      for (std::uint32_t f = 0; f < features.face_count(); ++f) {
        if (height_over(body, f, p) <= 0) continue;
        regions += !leave_face(body, f, p) ? 1 : 0;
      }
      EXPECT_EQ(regions, 1);
    }
  }
}

}  // namespace
}  // namespace carpus::convex
