// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The Novint Falcon's geometry [stamper1997thesis], with the measures that libnifalcon found: a
// delta whose forearms' ends stand d + e apart, so that the two ends of a forearm meet no single
// point and the tip is found by Newton's method. In leg i at phi_i, with u outwards, v along the
// joint, w along the arm:
//
//   (u + c - a cos t)^2 + (w - a sin t)^2 = (d + e + sqrt(b^2 - (v + f)^2))^2
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "geometry/vec3.hpp"

namespace carpus::devices {

using FalconAngles = std::array<double, 3>;

/// Counts of a leg's encoder to its angle [rad].
[[nodiscard]] double falcon_angle(std::int16_t counts) noexcept;
[[nodiscard]] std::int16_t falcon_counts(double angle) noexcept;

/// Angles that bring the tip there, in the Falcon's frame (x right, y up, z towards the user) [mm].
[[nodiscard]] std::optional<FalconAngles> falcon_inverse(const Vec3& tip) noexcept;
/// @param near  where it was last: Newton's method begins there.
[[nodiscard]] std::optional<Vec3> falcon_forward(const FalconAngles& angles,
                                                 const Vec3& near) noexcept;
/// Torques [N mm] that give the tip this force.
[[nodiscard]] std::optional<FalconAngles> falcon_torques(const Vec3& tip,
                                                         const FalconAngles& angles,
                                                         const Vec3& force) noexcept;

/// The middle of its workspace.
inline constexpr Vec3 kFalconCentre{0, 0, 115};

}  // namespace carpus::devices
