// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/portal_tool.hpp"

#include <algorithm>
#include <cmath>

namespace carpus::arm {

std::optional<PortalState> portal_state(const PortalTool& tool, const Vec3& handle) noexcept {
  const Vec3 to_portal = tool.portal - handle;
  PortalState state;
  state.outside_mm = length(to_portal);
  // A handle beside or below its portal would read the angles from the other side.
  if (!(state.outside_mm >= kLeastOutsideMm && to_portal.z < 0)) return std::nullopt;
  state.along = to_portal / state.outside_mm;
  state.tip = handle + state.along * tool.length_mm;
  state.depth_mm = tool.length_mm - state.outside_mm;
  state.pitch_rad = std::atan2(state.along.x, -state.along.z);
  state.yaw_rad = std::asin(std::clamp(state.along.y, -1.0, 1.0));
  if (!is_finite(state.tip)) return std::nullopt;
  return state;
}

std::optional<Vec3> handle_at(const PortalTool& tool, const Vec3& tip) noexcept {
  const Vec3 inside = tip - tool.portal;
  const double depth = length(inside);
  // Up to the portal any direction leads there.
  if (!(depth > 1e-6 * tool.length_mm && depth <= tool.length_mm - kLeastOutsideMm)) {
    return std::nullopt;
  }
  return tip - inside * (tool.length_mm / depth);
}

Vec3 through_portal(const PortalState& state, const Vec3& vector) noexcept {
  const Vec3 axial = state.along * dot(vector, state.along);
  return axial - (vector - axial) * (state.depth_mm / state.outside_mm);
}

Vec3 portal_force(const PortalState& state, const Vec3& tip_force) noexcept {
  return through_portal(state, tip_force) - tip_force;
}

Mat3 tool_rotation(const PortalState& state, double roll_rad) noexcept {
  return rotation_about({0, 1, 0}, -state.pitch_rad) * rotation_about({1, 0, 0}, state.yaw_rad) *
         rotation_about({0, 0, 1}, roll_rad);
}

}  // namespace carpus::arm
