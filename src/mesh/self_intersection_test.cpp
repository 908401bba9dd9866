// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces that are known to cross or not, and every pair against the slow obvious way.
#include "mesh/self_intersection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "geometry/grid.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::mesh {
namespace {

TriangleMesh ball(const Vec3& centre, double radius) {
  GridGeometry g;
  g.size = {24, 24, 24};
  g.origin = centre - Vec3{11.5, 11.5, 11.5};
  Grid<float> field(g);
  for (std::size_t i = 0; i < field.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    field[i] = static_cast<float>(radius - distance(p, centre));
  }
  return extract_isosurface(field.view(), 0);
}

TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.facets) a.facets.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

TEST(SelfIntersection, ABallHasNoneAndTwoThatOverlapCrossAlongACircle) {
  const TriangleMesh one = ball({0, 0, 0}, 7.3);
  EXPECT_EQ(count_self_intersections(one), 0U);
  EXPECT_EQ(count_self_intersections(together(one, ball({20, 0, 0}, 7.3))), 0U);
  EXPECT_EQ(count_self_intersections(together(one, ball({0.1, 0, 0}, 4.1))), 0U)
      << "one in the other";
  const std::size_t crossing = count_self_intersections(together(one, ball({9.1, 0.2, 0.3}, 7.3)));
  // A circle of 36 mm over facets of 1 mm.
  EXPECT_GT(crossing, 36U);
  EXPECT_LT(crossing, 400U);
  const std::vector<std::uint32_t> facets =
      crossing_facets(together(one, ball({9.1, 0.2, 0.3}, 7.3)));
  EXPECT_GT(facets.size(), 20U);
  EXPECT_LE(facets.size(), 2 * crossing);
  EXPECT_TRUE(std::is_sorted(facets.begin(), facets.end()));
  EXPECT_TRUE(crossing_facets(one).empty());
}

TEST(SelfIntersection, AVertexDrawnThroughTheOtherSideIsFound) {
  TriangleMesh mesh = ball({0, 0, 0}, 7.3);
  Vec3& vertex = mesh.vertices[mesh.facets[0][0]];
  vertex = vertex * -1.3;
  EXPECT_GT(count_self_intersections(mesh), 0U);
}

TEST(SelfIntersection, WhatTouchesDoesNotCross) {
  TriangleMesh two;
  two.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 2}, {1, 0.5, 2}};
  two.facets = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(count_self_intersections(two), 0U);
  two.vertices[3].z = -0.1;
  EXPECT_EQ(count_self_intersections(two), 1U);
  EXPECT_EQ(count_self_intersections({}), 0U);
}

/// Inside both triangles' segments by solving for the point.
bool crosses_slowly(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double s = dot(a - p, n) / dot(q - p, n);
  if (!(s > 0 && s < 1)) return false;
  const Vec3 x = p + (q - p) * s;
  return dot(cross(b - a, x - a), n) > 0 && dot(cross(c - b, x - b), n) > 0 &&
         dot(cross(a - c, x - c), n) > 0;
}

TEST(SelfIntersection, CountsWhatTheObviousWayCounts) {
  Rng rng(5);
  for (int round = 0; round < 20; ++round) {
    TriangleMesh soup;
    for (std::uint32_t k = 0; k < 60; ++k) {
      const Vec3 at{rng.uniform(0, 6), rng.uniform(0, 6), rng.uniform(0, 6)};
      for (int corner = 0; corner < 3; ++corner) {
        soup.vertices.push_back(at +
                                Vec3{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)});
      }
      soup.facets.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    std::size_t expected = 0;
    const auto corner = [&](std::size_t f, std::size_t k) {
      return soup.vertices[soup.facets[f][k % 3]];
    };
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
      for (std::size_t g = f + 1; g < soup.facets.size(); ++g) {
        bool cross = false;
        for (std::size_t k = 0; k < 3; ++k) {
          cross = cross ||
                  crosses_slowly(corner(f, k), corner(f, k + 1), corner(g, 0), corner(g, 1),
                                 corner(g, 2)) ||
                  crosses_slowly(corner(g, k), corner(g, k + 1), corner(f, 0), corner(f, 1),
                                 corner(f, 2));
        }
        expected += cross ? 1 : 0;
      }
    }
    EXPECT_EQ(count_self_intersections(soup), expected);
  }
}

}  // namespace
}  // namespace carpus::mesh
