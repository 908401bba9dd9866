// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The central axis of a long bone such as the scaphoid: the axis of the widest cylinder that fits
// inside it from pole to pole. The definition and its reasons: docs/scoring.md.
#pragma once

#include <optional>

#include "anatomy/bone_solid.hpp"
#include "geometry/vec3.hpp"

namespace carpus {

/// The cylinder is this long, relative to the longest straight line through the bone. A scaphoid is
/// about 28 mm long and 9 mm wide at its waist, so its poles are rounded over some 4 mm, 0.15 of
/// the length, each: the cylinder reaches from one pole's rounding to the other's. Were it longer,
/// the roundings would decide its radius; were it much shorter, it could tilt in the waist or lie
/// across.
inline constexpr double kCylinderLengthShare = 0.7;

/// A straight line through a bone, both ends on its surface [mm].
struct BoneLine {
  Vec3 start;
  Vec3 end;
};

/// Result of find_central_axis, in the frame of the solid [mm].
struct CentralAxis {
  BoneLine axis;         ///< start: the end that lies further along `towards_start`
  double radius_mm = 0;  ///< of the widest cylinder
  Vec3 waist;  ///< on the axis, where the bone's section is smallest; its middle if none is
  BoneLine longest_line;  ///< longest straight line inside the bone, same orientation
};

/// Finds the right circular cylinder of length kCylinderLengthShare * (longest line) and largest
/// radius that lies inside the bone (gap between fragments included), and extends its axis to the
/// surface. Deterministic; about 0.3 s.
///
/// @param towards_start  direction from the bone's middle to the pole that is to be `start`, e.g.
///                       proximal; only its sign along the axis matters.
/// @return nothing when no line can be fitted (a bone that is a shell or a few voxels).
[[nodiscard]] std::optional<CentralAxis> find_central_axis(const BoneSolid& bone,
                                                           const Vec3& towards_start);

}  // namespace carpus
