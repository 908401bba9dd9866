// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A straight way through the capsule into a joint as the hand is pulled, and how thick a tip goes
// along it between the bones.
#pragma once

#include <optional>

#include "arthroscopy/detail/pulled_bones.hpp"
#include "cases/arthroscopic_map.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

/// Frame Patient, under traction.
struct WayIn {
  Vec3 capsule;
  Vec3 inwards;        ///< unit
  double room_mm = 0;  ///< radius of what goes in there, to its working depth
};

/// From the capsule to the working depth along a line: how thick a tip goes there; none where it is
/// less than `stop_below_mm`, which is found out sooner.
[[nodiscard]] std::optional<WayIn> way_in(const cases::JointSpace& joint,
                                          const PulledBones& bones,
                                          const Vec3& from,
                                          const Vec3& inwards,
                                          double stop_below_mm);

/// By how much a way in leads past a point.
[[nodiscard]] double past_mm(const WayIn& way, const Vec3& point);

/// Whether a scope could not tell which of both it goes in by.
[[nodiscard]] bool share_hole(const WayIn& a, const WayIn& b);

}  // namespace carpus::arthroscopy::detail
