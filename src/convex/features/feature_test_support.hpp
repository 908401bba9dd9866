// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A course of poses for tests of methods between convex bodies, and a check of nearest points that
// needs no second method.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "core/rng.hpp"
#include "geometry/solids_test_support.hpp"

namespace carpus::test {

/// How far `p` is outside of the body [mm]. Facets thinner than a thousandth of a millimetre are
/// passed over: their rounded planes say nothing, and their neighbours bound the body as well.
inline double outside_by(const convex::ConvexBody& body, const Vec3& p) {
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
inline void expect_nearest(const convex::ConvexBody& first,
                           const convex::ConvexBody& second,
                           const convex::PairPose& pose,
                           const convex::Closest& closest,
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

  convex::PairPose next(double spread_mm) {
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

}  // namespace carpus::test
