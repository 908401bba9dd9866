// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geometry/vec3.hpp"

namespace carpus {

/// Where two segments are nearest to each other, as fractions of their ways. Only + - * /.
/// Source: [ericson2004realtime] §5.1.9.
struct NearestOnSegments {
  double a = 0;
  double b = 0;
};
[[nodiscard]] NearestOnSegments nearest_on_segments(const Vec3& a0,
                                                    const Vec3& a1,
                                                    const Vec3& b0,
                                                    const Vec3& b1) noexcept;

/// Least distance of two segments [mm], points and parallel ones too. Only + - * / and sqrt.
[[nodiscard]] double segment_distance(const Vec3& a0,
                                      const Vec3& a1,
                                      const Vec3& b0,
                                      const Vec3& b1) noexcept;

}  // namespace carpus
