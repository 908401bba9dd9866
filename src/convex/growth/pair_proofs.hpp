// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What proves, in doubles with their rounding bounded, that two bodies meet or are apart. A proof
// does not trust how its contents were found; ready_proof.hpp tries it again at the next pose.
#pragma once

#include <algorithm>
#include <cmath>

#include "convex/polar_graph.hpp"
#include "convex/relative_pose.hpp"
#include "geometry/tolerance.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// Sums of rows with weights >= 0: the first body lies in n . x <= first_reach, the second in
/// m . s <= second_reach, each about its origin. Where m is -n turned into the second's frame the
/// two half-spaces face each other.
struct SeparationProof {
  Vec3 n;
  double first_reach = 0;
  Vec3 m;
  double second_reach = 0;
  double size = 0;  ///< at least |n| [1/mm]

  /// Adds a row; the proof's arithmetic is covered by PolarGraph::reach() for up to four rows.
  void add_first(const Vec3& row, double weight, double reach) noexcept {
    n += row * weight;
    first_reach += weight * reach;
  }
  void add_second(const Vec3& row, double weight, double reach) noexcept {
    m += row * weight;
    second_reach += weight * reach;
  }
  void finish() noexcept { size = length(n) * (1 + 8 * kRoundoff); }

  /// The bodies are apart. What m differs from -n in the second body's frame, by turning or by
  /// rounding, costs that body's radius.
  [[nodiscard]] bool holds(const RelativePose& pose, double second_radius_mm) const noexcept {
    const double g = gap(pose) - rounding(pose, second_radius_mm);
    return g > kLeastGap && g * g > turned_squared(pose) * (1 + 32 * kRoundoff) * second_radius_mm *
                                        second_radius_mm;
  }
  /// Where it does not hold: no more is missing than what rounding may have taken.
  [[nodiscard]] bool may_hold(const RelativePose& pose, double second_radius_mm) const noexcept {
    const double g = gap(pose) + 4 * rounding(pose, second_radius_mm);
    return g > 0 || g * g < 4 * turned_squared(pose) * second_radius_mm * second_radius_mm;
  }

 private:
  /// Far above what underflow may have taken from products of lengths within 2^-100 and 2^100 mm.
  static constexpr double kLeastGap = 1e-100;

  [[nodiscard]] double turned_squared(const RelativePose& pose) const noexcept {
    return squared_length(pose.into_second(n) + m);
  }
  [[nodiscard]] double gap(const RelativePose& pose) const noexcept {
    return dot(n, pose.offset) - (first_reach + second_reach);
  }
  [[nodiscard]] double rounding(const RelativePose& pose, double second_radius_mm) const noexcept {
    return size * (pose.offset_error_mm + 8 * kRoundoff * taxicab(pose.offset) +
                   (16 * kRoundoff + pose.rotation_error) * second_radius_mm) +
           8 * kRoundoff * (first_reach + second_reach);
  }
};

/// A ball in each body: where they touch, the bodies meet. At the pose of the proof their centres
/// are one point.
struct CommonBallProof {
  Vec3 in_second;  ///< the second's centre, about the second's origin
  Vec3 in_first;   ///< the first's, about the first's origin
  double first_radius_mm = -1;
  double second_radius_mm = 0;

  /// The bodies meet.
  [[nodiscard]] bool holds(const RelativePose& pose) const noexcept {
    const Vec3 x = pose.rotation * in_second + pose.offset;
    const double r = radius(pose) - rounding(pose);
    return r >= 0 && r * r >= squared_length(x - in_first) * (1 + 32 * kRoundoff);
  }

 private:
  /// A matrix that is no rotation may flatten the second body's ball.
  [[nodiscard]] double radius(const RelativePose& pose) const noexcept {
    return first_radius_mm + (is_rigid(pose.rotation) ? second_radius_mm * kLeastStretch : 0);
  }
  [[nodiscard]] double rounding(const RelativePose& pose) const noexcept {
    const double reach = taxicab(in_second);
    return pose.offset_error_mm + pose.rotation_error * reach +
           16 * kRoundoff * (reach + taxicab(pose.offset) + taxicab(in_first));
  }
};

/// Tries a point near both bodies, given about the second's origin with the faces that the walks
/// found for it. True, and `proof` with it, if the point is proven to be in both.
[[nodiscard]] inline bool prove_common_point(const PolarGraph& first,
                                             const PolarGraph& second,
                                             const RelativePose& pose,
                                             const Vec3& in_second,
                                             std::uint32_t first_face,
                                             std::uint32_t second_face,
                                             CommonBallProof& proof) noexcept {
  const double second_gauge = second.gauge_bound(second_face, in_second);
  if (!(second_gauge <= 1)) return false;
  const Vec3 x = pose.rotation * in_second + pose.offset;
  const double gauge = first.gauge_bound(first_face, x);
  if (!(gauge <= 1)) return false;
  // x + the ball of (1 - gauge) * inner radius lies in the first body, which is convex.
  CommonBallProof found;
  found.in_second = in_second;
  found.in_first = x;
  found.first_radius_mm = (1 - gauge) * first.inner_radius_mm() * (1 - 4 * kRoundoff);
  found.second_radius_mm = (1 - second_gauge) * second.inner_radius_mm() * (1 - 4 * kRoundoff);
  if (!found.holds(pose)) return false;
  proof = found;
  return true;
}

}  // namespace carpus::convex
