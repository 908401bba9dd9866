// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bodies and poses for tests of methods between convex bodies, and a check of nearest points that
// needs no second method.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "core/rng.hpp"
#include "hull/quickhull.hpp"

namespace carpus::convex::test {

inline Mat3 random_rotation(Rng& rng) {
  return rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal());
}
inline Vec3 random_vector(Rng& rng) { return {rng.normal(), rng.normal(), rng.normal()}; }

inline void add_mirrored(std::vector<Vec3>& points, const Vec3& p) {
  for (int i = 0; i < 8; ++i) {
    points.push_back(
        {(i & 1) != 0 ? p.x : -p.x, (i & 2) != 0 ? p.y : -p.y, (i & 4) != 0 ? p.z : -p.z});
  }
}

inline constexpr std::uint64_t kSymmetricSolids = 6;

/// Cube, octahedron, bar, a solid of 24 corners, a prism of 16 sides, the lattice points of a ball.
inline std::vector<Vec3> symmetric_solid(std::uint64_t which) {
  std::vector<Vec3> points;
  if (which == 0) add_mirrored(points, {4, 4, 4});
  if (which == 1) {
    for (const Vec3& p : {Vec3{5, 0, 0}, Vec3{0, 5, 0}, Vec3{0, 0, 5}}) add_mirrored(points, p);
  }
  if (which == 2) add_mirrored(points, {1, 1, 12});
  if (which == 3) {
    for (const Vec3& p : {Vec3{2, 3, 6}, Vec3{6, 2, 3}, Vec3{3, 6, 2}}) add_mirrored(points, p);
  }
  if (which == 4) {
    Vec3 rim{5, 0, 3};
    const Mat3 turn = rotation_about({0, 0, 1}, 3.14159265358979323846 / 8);
    for (int i = 0; i < 16; ++i, rim = turn * rim) {
      points.push_back(rim);
      points.push_back({rim.x, rim.y, -rim.z});
    }
  }
  if (which == 5) {
    for (int i = 0; i < 343; ++i) {
      const Vec3 p{i % 7 - 3.0, i / 7 % 7 - 3.0, i / 49 - 3.0};
      if (dot(p, p) <= 9) points.push_back(p);
    }
  }
  return points;
}

/// Small polytopes: the solids above, these turned (so that rounding bends their faces), lattice
/// points, clouds, and points near a circle.
inline ConvexBody random_body(Rng& rng) {
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
    if (result.status == hull::HullStatus::Ok) return ConvexBody(std::move(result.polytope));
  }
}

/// A round body of the size of a wrist bone with some `count` vertices.
inline ConvexBody round_body(Rng& rng, std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = normalized_or(random_vector(rng), {1, 0, 0});
    points.push_back({7 * p.x, 10 * p.y, 13 * p.z});
  }
  hull::HullResult result = hull::build_convex_hull(points);
  EXPECT_EQ(result.status, hull::HullStatus::Ok);
  return ConvexBody(std::move(result.polytope));
}

inline ConvexBody box_body(const Vec3& half) {
  std::vector<Vec3> points;
  add_mirrored(points, half);
  return ConvexBody(hull::build_convex_hull(points).polytope);
}

/// How far `p` is outside of the body [mm]. Facets thinner than a thousandth of a millimetre are
/// passed over: their rounded planes say nothing, and their neighbours bound the body as well.
inline double outside_by(const ConvexBody& body, const Vec3& p) {
  constexpr double kThinnestMm = 1e-3;
  const ConvexPolytope& hull = body.polytope();
  double worst = -std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const Vec3& a = hull.vertices[hull.facets[f][0]];
    const Vec3& b = hull.vertices[hull.facets[f][1]];
    const Vec3& c = hull.vertices[hull.facets[f][2]];
    const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
    if (length(cross(b - a, c - a)) < kThinnestMm * longest) continue;
    worst = std::max(worst, hull.planes[f].signed_distance(p));
  }
  return worst;
}

/// The points lie on the bodies, and two planes across the normal keep the bodies as far apart as
/// the points are: nothing nearer exists.
inline void expect_nearest(const ConvexBody& first,
                           const ConvexBody& second,
                           const PairPose& pose,
                           const Closest& closest,
                           double tolerance_mm = 1e-9) {
  EXPECT_NEAR(distance(closest.on_first, closest.on_second), closest.distance_mm, tolerance_mm);
  EXPECT_NEAR(length(closest.normal), 1, 1e-12);
  const Vec3 own = pose.rotation.transposed() * (closest.on_second - pose.translation);
  EXPECT_LE(outside_by(first, closest.on_first), tolerance_mm);
  EXPECT_LE(outside_by(second, own), tolerance_mm);
  double high = -std::numeric_limits<double>::infinity();
  double low = std::numeric_limits<double>::infinity();
  for (const Vec3& v : first.vertices()) high = std::max(high, dot(closest.normal, v));
  for (const Vec3& v : second.vertices()) {
    low = std::min(low, dot(closest.normal, pose.rotation * v + pose.translation));
  }
  EXPECT_GE(low - high, closest.distance_mm - tolerance_mm);
}

/// A random walk of poses: small steps, now and then a jump.
class Trajectory {
 public:
  explicit Trajectory(std::uint64_t seed) : rng_(seed), rotation_(random_rotation(rng_)) {}

  PairPose next(double spread_mm) {
    if (rng_.below(20) == 0) {
      rotation_ = random_rotation(rng_);
      translation_ = random_vector(rng_) * spread_mm;
    }
    const Vec3 axis = normalized_or(random_vector(rng_), {1, 0, 0});
    rotation_ = rotation_about(axis, 0.02 * rng_.normal()) * rotation_;
    translation_ += random_vector(rng_) * 0.2;
    return {rotation_, translation_};
  }

 private:
  Rng rng_;
  Mat3 rotation_;
  Vec3 translation_{9, 3, -4};
};

}  // namespace carpus::convex::test
