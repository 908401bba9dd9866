// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The motions that the collision tables time, with the exact verdict for every pose.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "core/rng.hpp"

namespace carpus::bench {

/// Of one tick to the next: what a hand does in a millisecond, with a wide margin.
inline constexpr double kStepMm = 0.05;
inline constexpr double kStepRad = 0.1 * 3.14159265358979323846 / 180;

/// `rotation` about the point `centre`, then `shift`, of the second body in the first's frame.
[[nodiscard]] convex::PairPose moved(const convex::PairPose& pose,
                                     const Vec3& centre,
                                     const Mat3& rotation,
                                     const Vec3& shift);
[[nodiscard]] Vec3 random_direction(Rng& rng);

/// One pose to time, and the one that the method sees before it.
struct TimedPose {
  convex::PairPose before;
  convex::PairPose at;
  bool meet = false;     ///< exactly
  bool is_near = false;  ///< touching up to rounding: either verdict of a rounded method will do
};

/// Poses of one pair of bodies in one of the five cases.
struct PoseScript {
  std::vector<TimedPose> poses;
  /// Each pose follows the one before it; otherwise `before` is asked first, untimed.
  bool is_trajectory = false;
};

/// apart_5mm, gap_0.01mm, gap_1e-9mm, touching (to the last bit), deep_1mm, trajectory.
[[nodiscard]] const std::vector<std::string>& pose_cases();
[[nodiscard]] PoseScript make_poses(const std::string& pose_case,
                                    const convex::ConvexBody& first,
                                    const convex::ConvexBody& second,
                                    std::size_t count,
                                    std::uint64_t seed);

/// Poses at the given distance along the normal of contact: below zero, that deep or less.
[[nodiscard]] PoseScript poses_at_gap(double gap_mm,
                                      const convex::ConvexBody& first,
                                      const convex::ConvexBody& second,
                                      std::size_t count,
                                      std::uint64_t seed);

}  // namespace carpus::bench
