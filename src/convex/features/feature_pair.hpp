// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Nearest points of a pair of features at which a walk ended, and their proof.
#pragma once

#include <optional>

#include "convex/features/placement.hpp"
#include "convex/features/voronoi_features.hpp"
#include "convex/pair_query.hpp"

namespace carpus::convex {

struct FeaturePair {
  Feature first;
  Feature second;
  bool operator==(const FeaturePair&) const = default;
};

/// Nearest points of two features, one of them not of higher dimension than an edge or the other a
/// vertex: the pairs at which a walk can end. Empty for an edge and a face, and for two faces,
/// which never hold the nearest points alone, and for a vertex below or beside a face.
/// The distance of a vertex to a face is measured along the face's normal; else it is the length
/// between the two points.
[[nodiscard]] std::optional<Closest> closest_of(const FixedBody& first,
                                                const MovedBody& second,
                                                const FeaturePair& pair) noexcept;

/// From coordinates about the first body's centre to those of its frame.
[[nodiscard]] inline Closest moved_by(Closest closest, const Vec3& centre) noexcept {
  closest.on_first += centre;
  closest.on_second += centre;
  return closest;
}

/// How far the bodies are apart along a direction, and at which vertices.
struct GapAlong {
  double gap_mm = 0;
  FeaturePair extremes;
};

/// Along the unit vector `normal` (from the first to the second): a lower bound of their distance.
/// Climbs from the pair's features. O(steps).
[[nodiscard]] GapAlong gap_along(const FixedBody& first,
                                 const MovedBody& second,
                                 const FeaturePair& pair,
                                 const Vec3& normal) noexcept;

/// A vertex of the feature: itself, a tail, a face's first corner.
[[nodiscard]] std::uint32_t vertex_of(const VoronoiFeatures& features,
                                      const Feature& feature) noexcept;

}  // namespace carpus::convex
