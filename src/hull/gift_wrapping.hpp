// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Convex hull by gift wrapping [chand1970algorithm], [yaacoub2008] §4.3.
#pragma once

#include <span>

#include "geometry/vec3.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// The same result as build_convex_hull. Faces are wrapped whole: all points in a face's plane are
/// taken at once, so that coplanar points cannot make faces overlap.
/// Cost: O(n h), h the number of corners (and O(n log n) to drop duplicates).
[[nodiscard]] HullResult build_hull_by_gift_wrapping(std::span<const Vec3> points,
                                                     const HullOptions& options = {});

}  // namespace carpus::hull
