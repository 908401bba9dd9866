// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What goes on from a joint into the intervals that open into it, and through what is torn at their
// far end (docs/decisions/0082-an-interval-is-closed-by-cartilage-that-goes-with-its-bones.md).
// Pure.
#pragma once

#include <cstdint>
#include <span>

#include "arthroscopy/bone_interval.hpp"
#include "geometry/pose.hpp"
#include "simulation/detail/yielding_sheet.hpp"

namespace carpus::simulation::detail {

/// Whether from this joint a sheet is met from behind, at the far end of an interval.
[[nodiscard]] bool lies_behind(const YieldingSheet& sheet, std::uint8_t joint) noexcept;

/// Where a ball lies in the intervals that a joint opens into; in none it is clear of everything.
/// @param inverses  into frame Bone, by body
/// @param middle  frame Patient
/// Real-time: no allocation, bounded.
[[nodiscard]] arthroscopy::InInterval in_intervals(
    std::span<const YieldingSheet> sheets,
    std::span<const Pose<frame::Bone, frame::Patient>> inverses,
    std::uint8_t joint,
    const Vec3& middle,
    double radius_mm) noexcept;

/// Whether what is beside an interval that lets it in goes back there, and not into the joint.
/// @param off_mm  behind the joint's wall, where that is near
[[nodiscard]] bool leads_back(const arthroscopy::InInterval& interval,
                              double off_mm,
                              bool is_wall_near) noexcept;

}  // namespace carpus::simulation::detail
