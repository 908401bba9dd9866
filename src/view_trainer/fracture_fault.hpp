// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a view shows of two pieces of a bone that do not meet.
#pragma once

#include "geometry/vec3.hpp"

namespace carpus::view_trainer {

/// Across a fracture's face [mm]: the mean of a waist's two widths [clinical: B13, S47: 11.3
/// by 8.7]. A wider one hides a gap from more views than is told, a narrower one from fewer.
inline constexpr double kFaceAcrossMm = 10.0;

/// How far the pieces lie from each other: from the middle of one fracture face to the other's.
struct FractureFault {
  Vec3 normal;  ///< unit, of the first face
  Vec3 way;     ///< between the middles [mm], same frame

  [[nodiscard]] double gap_mm() const noexcept { return dot(way, normal); }
  [[nodiscard]] Vec3 step() const noexcept { return way - normal * gap_mm(); }
};

/// Clear between the faces, seen along `ray` (unit), in the plane of the bone [mm]: of a plane slot
/// as wide as the gap and kFaceAcrossMm deep. Negative where one piece hides the gap by so much.
[[nodiscard]] double clear_gap_mm(const FractureFault& fault, const Vec3& ray) noexcept;

/// Between the pieces' edges, seen along `ray` (unit), in the plane of the bone [mm].
[[nodiscard]] double seen_step_mm(const FractureFault& fault, const Vec3& ray) noexcept;

}  // namespace carpus::view_trainer
