// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The delta arm as the host sees it: the inverse of what the firmware computes
// (firmware/core/delta.hpp, whose equations and frame these are), where it can reach, and how much
// force it has there.
#pragma once

#include <array>
#include <optional>

#include "firmware/core/delta.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arm {

using LegAngles = std::array<double, 3>;

/// Lengths [mm] and limits [rad] of the arm that can be printed: 100 x 100 x 80 mm about its
/// centre.
struct DeltaArm {
  firmware::DeltaSize<double> size;
  double least_angle = -1.012;  ///< 58 degrees above the horizontal
  double most_angle = 1.367;    ///< 78.3 degrees below: the farthest corner needs 78.1
  /// The middle of the workspace [mm].
  Vec3 centre{0, 0, -130};
};

/// Angles of the legs that bring the tip to a place [mm]; none where it is out of reach.
[[nodiscard]] std::optional<LegAngles> inverse(const DeltaArm& arm, const Vec3& tip) noexcept;

/// The tip at these angles; none where the rods do not meet or the arm is near a singularity.
[[nodiscard]] std::optional<Vec3> forward(const DeltaArm& arm, const LegAngles& angles) noexcept;

/// Whether the place can be worked in: reached within the legs' limits, away from singularities.
[[nodiscard]] bool is_in_workspace(const DeltaArm& arm, const Vec3& tip) noexcept;

/// What a place is worth.
struct Strength {
  double weakest_n_per_nm = 0;  ///< force in the worst direction, from 1 N m in each leg
  double condition = 0;         ///< of the Jacobian: 1 where all directions are alike
};
/// @return none outside the workspace.
[[nodiscard]] std::optional<Strength> strength_at(const DeltaArm& arm, const Vec3& tip) noexcept;

}  // namespace carpus::arm
