// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Do two triangles in space have a point in common? Exact.
#pragma once

#include <array>
#include <cmath>

#include "geometry/vec3.hpp"

namespace carpus::survey {

/// Corners [mm].
using TrianglePoints = std::array<Vec3, 3>;

/// Coordinates below this are taken as zero before the exact test, so that its rare exact products
/// need no numbers of unlimited length (and no memory). No body notices 5e-85 mm.
inline constexpr double kLeastTriangleCoordinate = 0x1.0p-280;

[[nodiscard]] inline Vec3 without_tiny_coordinates(const Vec3& v) noexcept {
  const auto kept = [](double c) { return std::abs(c) < kLeastTriangleCoordinate ? 0.0 : c; };
  return {kept(v.x), kept(v.y), kept(v.z)};
}

/// True if the closed triangles have a point in common; exact for the coordinates as given, finite,
/// at most kLargestCoordinate and without tiny ones. Triangles may be coplanar, and may be segments
/// or points.
/// Signs of determinants of four corners decide [guigue2003fast]; where planes are not the same, an
/// edge of one triangle meets the other one.
[[nodiscard]] bool triangles_meet(const TrianglePoints& a, const TrianglePoints& b) noexcept;

}  // namespace carpus::survey
