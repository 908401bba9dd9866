// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Convex hull by Chan's output-sensitive algorithm [chan1996optimal], [yaacoub2008] §4.4.4.
#pragma once

#include <span>

#include "geometry/vec3.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// The same result as build_convex_hull. Groups of N points get hulls of their own, which are
/// wrapped; N = min(2^(2^t), n), t = 0, 1, ..., until the hull has no more than N corners.
/// statistics.points_discarded counts points inside the hull of their group.
/// Cost: O(n log h), h the number of corners, where the groups' hulls cost O(N log N); and
/// O(n log n) to drop duplicates.
[[nodiscard]] HullResult build_hull_by_chan(std::span<const Vec3> points,
                                            const HullOptions& options = {});

}  // namespace carpus::hull
