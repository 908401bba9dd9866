// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Convex bodies and poses for tests: regular bodies, on which everything ties, thin ones, bone-like
// ones and round ones with many corners.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "core/amount_test_support.hpp"
#include "core/rng.hpp"
#include "geometry/solids_test_support.hpp"
#include "hull/quickhull.hpp"

namespace carpus::test {

[[nodiscard]] inline convex::ConvexBody body_of(const std::vector<Vec3>& points) {
  return convex::ConvexBody(hull::build_convex_hull(points).polytope);
}
[[nodiscard]] inline convex::ConvexBody box(const Vec3& half) { return body_of(box_points(half)); }
[[nodiscard]] inline convex::ConvexBody octahedron(double r) {
  return body_of(octahedron_points(r));
}
[[nodiscard]] inline convex::ConvexBody prism(int sides, double radius, double half_length) {
  return body_of(prism_points(sides, radius, half_length));
}
[[nodiscard]] inline convex::ConvexBody lattice_ball(int radius) {
  return body_of(lattice_ball_points(radius));
}

/// Points of a bumpy ellipsoid, as of a carpal bone, about a point off the frame's origin.
[[nodiscard]] inline convex::ConvexBody pebble(Rng& rng,
                                               int points,
                                               const Vec3& centre = {3, -2, 5}) {
  std::vector<Vec3> cloud;
  const Vec3 bump = random_direction(rng);
  for (int i = 0; i < points; ++i) {
    const Vec3 d = random_direction(rng);
    const double r = 1 + 0.2 * dot(d, bump) * dot(d, bump) * dot(d, bump);
    cloud.push_back(centre + Vec3{9 * d.x, 6 * d.y, 5 * d.z} * r);
  }
  return body_of(cloud);
}

inline constexpr std::uint64_t kSymmetricSolids = 6;

/// Cube, octahedron, bar, a solid of 24 corners, a prism of 16 sides, the lattice points of a ball.
inline std::vector<Vec3> symmetric_solid(std::uint64_t which) {
  if (which == 0) return box_points({4, 4, 4});
  if (which == 1) return octahedron_points(5);
  if (which == 2) return box_points({1, 1, 12});
  if (which == 4) return prism_points(16, 5, 3);
  if (which == 5) return lattice_ball_points(3);
  std::vector<Vec3> points;
  for (const Vec3& p : {Vec3{2, 3, 6}, Vec3{6, 2, 3}, Vec3{3, 6, 2}}) {
    for (const Vec3& corner : box_points(p)) points.push_back(corner);
  }
  return points;
}

/// Small polytopes: the solids above, these turned (so that rounding bends their faces), lattice
/// points, clouds, and points near a circle.
inline convex::ConvexBody random_body(Rng& rng) {
  while (true) {
    const std::uint64_t kind = rng.below(10);
    std::vector<Vec3> points;
    if (kind < 4) {
      points = symmetric_solid(rng.below(kSymmetricSolids));
      const Mat3 turn = random_rotation(rng);
      if (kind == 3) {
        for (Vec3& p : points) p = turn * p;
      }
    } else {
      const std::uint64_t range = 3 + rng.below(10);
      const auto lattice = [&] { return static_cast<double>(rng.below(range)); };
      for (std::uint64_t i = 4 + rng.below(20); i > 0; --i) {
        const Vec3 p = random_vector(rng);
        if (kind < 6) points.push_back({lattice(), lattice(), lattice()});
        if (kind >= 6 && kind < 9) points.push_back(p * 3.0);
        if (kind == 9) points.push_back(normalized_or({p.x, p.y, p.z / 10}, {1, 0, 0}) * 5.0);
      }
    }
    hull::HullResult result = hull::build_convex_hull(points);
    if (result.status == hull::HullStatus::Ok)
      return convex::ConvexBody(std::move(result.polytope));
  }
}

/// A round body of the size of a wrist bone with some `count` vertices.
inline convex::ConvexBody round_body(Rng& rng, int count) {
  return body_of(round_points(rng, count, {7, 10, 13}));
}

struct Solid {
  std::string name;
  convex::ConvexBody body;
};

/// At most some 60 corners each, so that exhaustive oracles stay affordable.
inline const std::vector<Solid>& small_solids() {
  static const std::vector<Solid> solids = [] {
    Rng rng(20260101);
    std::vector<Solid> s;
    s.push_back({"cube", body_of(box_points({1, 1, 1}))});
    s.push_back({"slab", body_of(box_points({3, 2, 0.01}))});
    s.push_back({"octahedron", octahedron(2)});
    s.push_back({"tetrahedron", body_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}})});
    s.push_back({"prism", body_of(prism_points(16, 1.5, 1))});
    s.push_back({"lattice ball", body_of(lattice_ball_points(2))});
    s.push_back({"needle", body_of(box_points({0.01, 0.013, 10}))});
    s.push_back({"cloud", body_of(round_points(rng, 30, {3, 2, 1}))});
    s.push_back(
        {"sliver",
         body_of({{-2, 0, 0}, {2, 1e-7, 0}, {0, 1e-6, 2}, {0.3, 1e-3, -2}, {0.1, -1e-6, 1.9}})});
    return s;
  }();
  return solids;
}

/// The same body with its coordinates about another point of its frame.
inline convex::ConvexBody shifted(const convex::ConvexBody& body, const Vec3& by) {
  std::vector<Vec3> points;
  for (const Vec3& v : body.vertices()) points.push_back(v + by);
  return body_of(points);
}

/// One of the 24 rotations of a cube onto itself: exact, and everything ties.
inline Mat3 lattice_rotation(Rng& rng) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::swap(order[0], order[rng.below(3)]);
  std::swap(order[1], order[1 + rng.below(2)]);
  Mat3 m{{Vec3{}, Vec3{}, Vec3{}}};
  for (std::size_t i = 0; i < 3; ++i) m.rows[i][order[i]] = rng.below(2) == 0 ? 1 : -1;
  if (m.determinant() < 0) m.rows[0] *= -1;
  return m;
}

/// Any pose, or one on which features are parallel and offsets lie on a grid; nearly so, too.
inline convex::PairPose random_pose(Rng& rng, double reach_mm) {
  convex::PairPose pose;
  const std::uint64_t kind = rng.below(4);
  if (kind == 0) {
    pose.rotation = random_rotation(rng);
    pose.translation = random_direction(rng) * rng.uniform(0, reach_mm);
    return pose;
  }
  pose.rotation = lattice_rotation(rng);
  for (std::size_t i = 0; i < 3; ++i) {
    pose.translation[i] = 0.5 * std::floor(rng.uniform(-2 * reach_mm, 2 * reach_mm) + 0.5);
  }
  if (kind == 2) {  // nearly parallel
    const std::array angles{1e-3, 1e-6, 1e-9, 1e-12, 1e-15};
    pose.rotation =
        rotation_about(random_direction(rng), angles[rng.below(angles.size())]) * pose.rotation;
  }
  if (kind == 3) pose.translation += random_direction(rng) * rng.uniform(0, 1e-6);
  return pose;
}

/// A smooth course of poses about a body: near, into and away again.
inline convex::PairPose pose_on_a_course(double t, double reach_mm) {
  return {rotation_about({0.6, 0, 0.8}, t),
          Vec3{reach_mm * (1 + 0.25 * std::sin(3 * t)), reach_mm * 0.3 * std::sin(t),
               reach_mm * 0.2 * std::cos(2 * t)}};
}

/// Cases of a test: `usual`, a tenth with CARPUS_QUICK=1, a hundred times as many with
/// CARPUS_LONG=1.
inline std::uint64_t cases(std::uint64_t usual) {
  return amount(usual / 10 + 1, usual, usual * 100);
}

}  // namespace carpus::test
