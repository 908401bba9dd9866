// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Convex hull in the plane by the algorithms of the thesis's chapter 4 [yaacoub2008].
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/predicates.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// All give the same result; n points, h corners.
enum class PlanarAlgorithm {
  BruteForce,    ///< every pair with all others on one side; O(n^3)
  GiftWrapping,  ///< Jarvis's march; O(n h)
  Quickhull,     ///< farthest points first; O(n log n) on average, O(n^2) worst
  GrahamScan,    ///< sorted by x and scanned below and above; O(n log n)
  Chan,          ///< groups scanned, then wrapped with logarithmic tangents; O(n log h)
  Hybrid,        ///< points strictly inside two triangles discarded, then gift wrapping
  Fast,          ///< the same points discarded, then Graham's scan
};

/// Starts in a failed state. Ok: at least three corners that are not on one line.
struct PlanarHullResult {
  HullStatus status = HullStatus::TooFewPoints;  ///< TooFewPoints below three; never Coplanar
  /// Indices of the corners, counter-clockwise from the least in (x, y); points on an edge between
  /// corners are none. Of duplicates the lowest index is named.
  std::vector<std::uint32_t> corners;
  HullStatistics statistics;
};

/// The convex hull of `points` as given, every sign exact. Order is irrelevant, duplicates allowed.
[[nodiscard]] PlanarHullResult build_planar_hull(std::span<const Vec2> points,
                                                 PlanarAlgorithm algorithm);

}  // namespace carpus::hull
