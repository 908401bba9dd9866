// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Four rows as they lie at a new pose: do the two edges, or the face and the vertex, that they
// stand for still have a plane between them? Without solving the basis, without a division.
#pragma once

#include <array>
#include <cmath>

#include "convex/growth/growth_basis.hpp"
#include "convex/growth/pair_proofs.hpp"
#include "convex/relative_pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// Numbers >= 0 so that w0 a + w1 b + w2 c is a positive multiple of -d: Cramer's rule without its
/// division, for what follows does not depend on a common factor.
struct ConeWeights {
  std::array<double, 3> w{};
  double of_d = 0;
  bool are_valid = false;

  ConeWeights(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) noexcept {
    const Vec3 bc = cross(b, c);
    const double determinant = dot(a, bc);
    const Vec3 opposite = determinant < 0 ? d : -d;
    w = {dot(opposite, bc), dot(opposite, cross(c, a)), dot(opposite, cross(a, b))};
    of_d = std::abs(determinant);
    are_valid = w[0] >= 0 && w[1] >= 0 && w[2] >= 0 && of_d > 0;
  }
};

/// The separation that four rows with weights >= 0 make, the growth program's bound of t in another
/// form: t > 1 iff its half-spaces leave a gap. With rows p of the first body (they stand first), q
/// of the second and the rotation R:
///     two and two    n = (p0 x p1) x R(q0 x q1), the direction square to both edges,
///                      = p1 (p0 . f) - p0 (p1 . f) with f = R(q0 x q1);
///     one and three  n = p, and -R'p in the cone of the q; likewise three and one.
/// False where a weight is negative: other rows bind there.
[[nodiscard]] inline bool separation_of_rows(const std::array<GrowthRow, 4>& rows,
                                             int first_rows,
                                             const RelativePose& pose,
                                             double first_reach,
                                             double second_reach,
                                             SeparationProof& proof) noexcept {
  const Vec3& r0 = rows[0].normal;
  const Vec3& r1 = rows[1].normal;
  const Vec3& r2 = rows[2].normal;
  const Vec3& r3 = rows[3].normal;
  if (first_rows == 2) {
    const Vec3 f = pose.rotation * cross(r2, r3);
    const Vec3 g = pose.into_second(cross(r0, r1));
    const double along = dot(r0, f);
    const double sign = along < 0 ? -1 : 1;  // a normal and its opposite are both square to them
    const double w1 = sign * along;
    const double w0 = -sign * dot(r1, f);
    const double w3 = sign * dot(r2, g);
    const double w2 = -sign * dot(r3, g);
    if (!(w0 >= 0 && w2 >= 0 && w3 >= 0 && w1 > 0)) return false;
    proof.n = r0 * w0 + r1 * w1;
    proof.m = r2 * w2 + r3 * w3;
    proof.first_reach = (w0 + w1) * first_reach;
    proof.second_reach = (w2 + w3) * second_reach;
  } else if (first_rows == 1) {
    const ConeWeights cone(r1, r2, r3, pose.into_second(r0));
    if (!cone.are_valid) return false;
    proof.n = r0 * cone.of_d;
    proof.m = r1 * cone.w[0] + r2 * cone.w[1] + r3 * cone.w[2];
    proof.first_reach = cone.of_d * first_reach;
    proof.second_reach = (cone.w[0] + cone.w[1] + cone.w[2]) * second_reach;
  } else if (first_rows == 3) {
    const ConeWeights cone(r0, r1, r2, pose.rotation * r3);
    if (!cone.are_valid) return false;
    proof.n = r0 * cone.w[0] + r1 * cone.w[1] + r2 * cone.w[2];
    proof.m = r3 * cone.of_d;
    proof.first_reach = (cone.w[0] + cone.w[1] + cone.w[2]) * first_reach;
    proof.second_reach = cone.of_d * second_reach;
  } else {
    return false;
  }
  proof.finish();
  return true;
}

}  // namespace carpus::convex
