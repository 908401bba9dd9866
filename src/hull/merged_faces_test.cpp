// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/merged_faces.hpp"
#include "hull/polytope_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "geometry/predicates.hpp"
#include "hull/detail/degenerate_points.hpp"
#include "hull/quickhull.hpp"

namespace carpus::hull {
namespace {

TEST(MergedFaces, MakeASampledBoxOfSixRectangles) {
  std::vector<Vec3> points;
  for (int i = 0; i < 125; ++i)
    points.push_back({0.3 * (i % 5), 0.7 * (i / 5 % 5), 1.1 * (i / 25)});
  const HullResult hull = build_convex_hull(points);
  const std::vector<PolygonalFace> faces = merged_faces(hull.polytope);
  ASSERT_EQ(faces.size(), 6U);
  for (const PolygonalFace& face : faces) {
    EXPECT_EQ(face.corners.size(), 4U);
    EXPECT_EQ(face.facets.size(), 2U);
  }
  const PolytopeMeasures measures = measures_of(hull.polytope);
  EXPECT_NEAR(measures.volume_mm3, 1.2 * 2.8 * 4.4, 1e-12);
  EXPECT_NEAR(measures.area_mm2, 2 * (1.2 * 2.8 + 2.8 * 4.4 + 1.2 * 4.4), 1e-12);
  EXPECT_LT(distance(measures.centroid, {0.6, 1.4, 2.2}), 1e-12);
}

void expect_consistent(const ConvexPolytope& polytope) {
  const std::vector<PolygonalFace> faces = merged_faces(polytope);
  std::size_t sides = 0;
  std::size_t facets = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const PolygonalFace& face = faces[i];
    const std::size_t k = face.corners.size();
    sides += k;
    facets += face.facets.size();
    ASSERT_EQ(face.neighbours.size(), k);
    ASSERT_EQ(face.facets.size(), k - 2);
    for (std::size_t e = 0; e < k; ++e) {
      const PolygonalFace& other = faces[face.neighbours[e]];
      const std::size_t m = other.corners.size();
      const auto at = static_cast<std::size_t>(
          std::find(other.corners.begin(), other.corners.end(), face.corners[(e + 1) % k]) -
          other.corners.begin());
      ASSERT_LT(at, m);
      ASSERT_EQ(other.corners[(at + 1) % m], face.corners[e]);
      ASSERT_EQ(other.neighbours[at], i);
      // Different planes: some corner of the other is strictly below.
      const auto& v = polytope.vertices;
      ASSERT_TRUE(std::any_of(other.corners.begin(), other.corners.end(), [&](std::uint32_t c) {
        return orient3d(v[face.corners[0]], v[face.corners[1]], v[face.corners[2]], v[c]) < 0;
      }));
    }
  }
  EXPECT_EQ(facets, polytope.facets.size());
  EXPECT_EQ(polytope.vertices.size() + faces.size(), sides / 2 + 2);  // V - E + F = 2
}

TEST(MergedFaces, AreConsistentOnDegenerateInput) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const HullResult hull = build_convex_hull(random_points(seed));
    if (hull.status == HullStatus::Ok) expect_consistent(hull.polytope);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

}  // namespace
}  // namespace carpus::hull
