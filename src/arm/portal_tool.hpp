// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A tool that the arm holds at one end and that passes a portal, a plug at a fixed place in the
// wrist shell (hardware/). The portal turns the three positions of the arm into what an instrument
// in a joint can do: two angles and a depth. With h the handle (the centre of the platform's
// gimbal), p the portal, L the tool's length:
//
//   u = (p - h) / |p - h|,   tip = h + L u,   l_out = |p - h|,   l_in = L - l_out
//   d tip = M d h,   F_handle = M F_tip,   M = u u^T - (l_in / l_out) (1 - u u^T)
//
// M is symmetric, as virtual work asks. Across the shaft the tool is a lever about the portal,
// which takes the rest of the force: a bone of stiffness K feels like (l_in / l_out)^2 K, and a
// weak arm is strong enough.
#pragma once

#include <optional>

#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arm {

/// Lengths [mm], in the arm's frame.
struct PortalTool {
  Vec3 portal{0, 0, -230};
  double length_mm = 125;  ///< from the gimbal's centre to the tip
};

/// Nearer to the portal than this [mm] the handle's direction says nothing: the gimbal and the
/// shell would touch.
inline constexpr double kLeastOutsideMm = 20.0;

struct PortalState {
  Vec3 tip;
  Vec3 along;            ///< unit, from the handle to the tip
  double pitch_rad = 0;  ///< lean to +x: about the gimbal's outer axis, which is the platform's y
  double yaw_rad = 0;    ///< lean to +y: about its inner axis
  double depth_mm = 0;   ///< of the tip behind the portal; negative while it is outside
  double outside_mm = 0;
};

/// @param handle  the arm's tip. @return none too near the portal, above it, or not finite.
[[nodiscard]] std::optional<PortalState> portal_state(const PortalTool& tool,
                                                      const Vec3& handle) noexcept;

/// The handle that brings the tip to a place behind the portal. @return none at the portal itself.
[[nodiscard]] std::optional<Vec3> handle_at(const PortalTool& tool, const Vec3& tip) noexcept;

/// Force or velocity across the lever, M of above: the handle's force from the tip's, the tip's
/// velocity from the handle's.
[[nodiscard]] Vec3 through_portal(const PortalState& state, const Vec3& vector) noexcept;

/// What the portal adds to a force at the tip, so that the hand and it hold the tool together:
/// across the shaft alone.
[[nodiscard]] Vec3 portal_force(const PortalState& state, const Vec3& tip_force) noexcept;

/// How the tool lies: origin's axes are the arm's where it hangs straight down; +z goes from the
/// tip to the hand, `roll_rad` turns it about that in the gimbal (the scope's ring).
[[nodiscard]] Mat3 tool_rotation(const PortalState& state, double roll_rad) noexcept;

}  // namespace carpus::arm
