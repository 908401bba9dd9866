// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the second body lies in the first one's frame, about the origins of both polar graphs, with
// bounds of what rounding did.
#pragma once

#include <cmath>

#include "convex/pair_query.hpp"
#include "convex/polar_graph.hpp"
#include "geometry/mat3.hpp"
#include "geometry/tolerance.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

[[nodiscard]] inline double taxicab(const Vec3& v) noexcept {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

[[nodiscard]] inline double squared_norm(const Mat3& m) noexcept {
  return squared_length(m.rows[0]) + squared_length(m.rows[1]) + squared_length(m.rows[2]);
}

/// A matrix with a squared norm of at most 3 (1 + e) and a determinant of at least 1 - e stretches
/// no vector by less than 1 - 2 sqrt(e): the singular values 1 + d hold sum (2 d + d^2) <= 3 e and
/// sum (d - d^2 / 2 + d^3 / 3) >= -1.01 e, so that sum d^2 <= 3.1 e.
inline constexpr double kRigidTolerance = 1e-9;
inline constexpr double kLeastStretch = 1 - 1e-4;
[[nodiscard]] inline bool is_rigid(const Mat3& m) noexcept {
  return dot(m.rows[0], cross(m.rows[1], m.rows[2])) >= 1 - 0.9 * kRigidTolerance &&
         squared_norm(m) <= 3 * (1 + 0.9 * kRigidTolerance);
}

/// A point s of the second body about its origin is rotation * s + offset about the first one's.
struct RelativePose {
  Mat3 rotation;
  Vec3 offset;
  double rotation_error = 0;   ///< largest change of a unit vector [1]
  double offset_error_mm = 0;  ///< of the offset's length

  [[nodiscard]] Vec3 into_second(const Vec3& d) const noexcept {
    const auto& r = rotation.rows;
    return {r[0].x * d.x + r[1].x * d.y + r[2].x * d.z, r[0].y * d.x + r[1].y * d.y + r[2].y * d.z,
            r[0].z * d.x + r[1].z * d.y + r[2].z * d.z};
  }
};

/// Largest sum of squares of a matrix that proofs in doubles take; a rotation has 3. Others, and
/// what is not finite, go to exact arithmetic.
inline constexpr double kMostSquaredNorm = 3.1;
/// Largest component of a translation, likewise [mm].
inline constexpr double kMostTranslation = 0x1p100;

/// False where proofs in doubles are not possible at that pose.
[[nodiscard]] inline bool relative_pose(const PolarGraph& first,
                                        const PolarGraph& second,
                                        const PairPose& first_from_second,
                                        RelativePose& result) noexcept {
  const Vec3& t = first_from_second.translation;
  const double far = taxicab(t);
  result.rotation = first_from_second.rotation;
  result.offset = result.rotation * second.origin() + (t - first.origin());
  // Three products and three sums a component: under 16 units of the magnitudes.
  result.offset_error_mm =
      16 * kRoundoff * (taxicab(first.origin()) + taxicab(second.origin()) + far);
  return squared_norm(result.rotation) <= kMostSquaredNorm && far <= kMostTranslation;
}

}  // namespace carpus::convex
