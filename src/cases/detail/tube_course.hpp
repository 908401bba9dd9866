// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A tube's middle line between its given points: smooth, out of bone and of what lies on it, under
// the skin, apart from other tubes.
#pragma once

#include <cstddef>
#include <vector>

#include "cases/detail/carried_landmarks.hpp"
#include "geometry/vec3.hpp"

namespace carpus::cases::detail {

/// A tube while it is laid.
struct LaidTube {
  double radius_mm = 0;
  std::vector<Vec3> drawn;   ///< the curve through the given points, about kCourseStepMm apart
  std::vector<Vec3> line;    ///< where its points are pushed to
  std::vector<double> hold;  ///< by point: the part of a push that each pass takes back
};

/// Between neighbouring points of a line [mm].
inline constexpr double kCourseStepMm = 1.5;

/// A curve through the given points [catmull1974class].
[[nodiscard]] LaidTube through(const std::vector<Vec3>& given, double radius_mm);

/// Roughly: given points hold to the end, and small overlaps may stay. Wholly: until nothing is
/// left for which there is room, wherever that takes a line; from rough places that is not far.
enum class Settling { Roughly, Wholly };

/// Lets all tubes settle: each as it was drawn but for what pushes it, which it spreads along its
/// length; none in a bone, a soft body or another tube, or outside the skin as far as there is a
/// skin. Where there is no room for all that, the skin gives way first. Tubes that are clear of all
/// walls and of each other stay as they are, to the bit.
void settle(std::vector<LaidTube>& tubes, const WristSurfaces& surfaces, Settling how);

}  // namespace carpus::cases::detail
