// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The two bodies of a pair in the first one's axes about the first one's centre: the first as it
// is, the second moved by an affine map (a pose is taken as given, also where its matrix is a
// little off a rotation).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "convex/double_double.hpp"
#include "convex/features/voronoi_features.hpp"
#include "convex/pair_query.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// From the first one's centre to the second one's [mm]. Where these, or the translation, are far
/// from their origins in units of the bodies' size, with twice the digits: else everything that is
/// left of them after the subtraction would be rounding.
[[nodiscard]] inline Vec3 between_centres(const VoronoiFeatures& first,
                                          const VoronoiFeatures& second,
                                          const PairPose& pose) noexcept {
  constexpr double kFar = 256;
  const Vec3& from = second.centre();
  const Vec3& to = first.centre();
  const Vec3& t = pose.translation;
  const double near_mm = kFar * (first.radius_mm() + second.radius_mm());
  const double largest =
      std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z), std::abs(to.x),
                std::abs(to.y), std::abs(to.z), std::abs(t.x), std::abs(t.y), std::abs(t.z)});
  if (largest < near_mm) return pose.rotation * from + t - to;
  const auto along = [&](std::size_t i) noexcept {
    const Vec3& row = pose.rotation.rows[i];
    DoubleDouble sum = DoubleDouble::sum(t[i], -to[i]);
    sum = sum + DoubleDouble::product(row.x, from.x);
    sum = sum + DoubleDouble::product(row.y, from.y);
    sum = sum + DoubleDouble::product(row.z, from.z);
    return sum.high;
  };
  return {along(0), along(1), along(2)};
}

struct FixedBody {
  const VoronoiFeatures* features;

  [[nodiscard]] const Vec3& vertex(std::uint32_t v) const noexcept { return features->vertex(v); }
  /// Along the outward normal of a face; its length is about 1.
  [[nodiscard]] const Vec3& normal(std::uint32_t f) const noexcept {
    return features->plane(f).normal;
  }
  /// `w` so that dot(own(w), a - b) of the body's own coordinates is dot(w, a - b) of the common
  /// ones.
  [[nodiscard]] const Vec3& own(const Vec3& w) const noexcept { return w; }
  /// A common point in the body's own coordinates.
  [[nodiscard]] const Vec3& own_point(const Vec3& p) const noexcept { return p; }
};

struct MovedBody {
  const VoronoiFeatures* features;
  Mat3 linear;
  Mat3 transposed;
  Mat3 cofactors;  ///< normals follow these
  Vec3 translation;
  double determinant;
  double scale_mm;  ///< both radii and the distance of the centres, at most

  /// @param first  the other body, about whose centre everything is.
  MovedBody(const VoronoiFeatures& first,
            const VoronoiFeatures& second,
            const PairPose& pose) noexcept
      : features(&second),
        linear(pose.rotation),
        transposed(pose.rotation.transposed()),
        cofactors{{cross(linear.rows[1], linear.rows[2]), cross(linear.rows[2], linear.rows[0]),
                   cross(linear.rows[0], linear.rows[1])}},
        translation(between_centres(first, second, pose)),
        determinant(dot(linear.rows[0], cofactors.rows[0])),
        // (1 + F^2) / 2 >= F, the matrix' Frobenius norm, which bounds what it does to lengths.
        scale_mm(first.radius_mm() +
                 (0.5 + 0.5 * (squared_length(linear.rows[0]) + squared_length(linear.rows[1]) +
                               squared_length(linear.rows[2]))) *
                     second.radius_mm() +
                 length(translation)) {}

  /// False where the pose is not finite, turns the body inside out, or takes the scale out of 1e-30
  /// to 1e30 mm, where products of coordinates leave the doubles.
  [[nodiscard]] bool is_usable() const noexcept {
    return determinant > 0 && std::isfinite(determinant) && scale_mm > 1e-30 && scale_mm < 1e30;
  }
  [[nodiscard]] Vec3 vertex(std::uint32_t v) const noexcept {
    return linear * features->vertex(v) + translation;
  }
  [[nodiscard]] Vec3 normal(std::uint32_t f) const noexcept {
    return cofactors * features->plane(f).normal;
  }
  [[nodiscard]] Vec3 own(const Vec3& w) const noexcept { return transposed * w; }
  [[nodiscard]] Vec3 own_point(const Vec3& p) const noexcept {
    return cofactors.transposed() * (p - translation) / determinant;
  }
};

}  // namespace carpus::convex
