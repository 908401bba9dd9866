// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Voronoi regions of vertices, edges and faces [lin1991incremental]: does a point lie in one,
// and if not, behind which neighbour's plane? No tolerances: a tie counts as inside.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "convex/features/segments.hpp"
#include "convex/features/voronoi_features.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// The edge of `v` behind whose plane a point lies, `from_vertex` away from `v`: the edge that goes
/// farthest along this vector.
template <typename Body>
[[nodiscard]] std::optional<Feature> leave_vertex(const Body& body,
                                                  std::uint32_t v,
                                                  const Vec3& from_vertex) noexcept {
  const Vec3 towards = body.own(from_vertex);
  const Vec3& at = body.features->vertex(v);
  const std::span<const VoronoiFeatures::Spoke> spokes = body.features->spokes(v);
  double worst = 0;
  std::size_t slot = spokes.size();
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    const double beyond = dot(body.features->vertex(spokes[i].end) - at, towards);
    if (beyond > worst) {
      worst = beyond;
      slot = i;
    }
  }
  if (slot == spokes.size()) return std::nullopt;
  return body.features->spoke_edge(v, slot);
}

/// An edge with the planes of its region.
struct EdgeRegion {
  Vec3 tail;
  Vec3 head;
  Vec3 along;       ///< head - tail
  Vec3 into_left;   ///< within the left face, square to the edge
  Vec3 into_right;  ///< within the right face
};

template <typename Body>
[[nodiscard]] EdgeRegion region_of_edge(const Body& body, const Feature& edge) noexcept {
  EdgeRegion region;
  region.tail = body.vertex(edge.id);
  region.head = body.vertex(edge.head);
  region.along = region.head - region.tail;
  region.into_left = cross(body.normal(edge.left), region.along);
  region.into_right = cross(region.along, body.normal(edge.right));
  return region;
}

[[nodiscard]] inline std::optional<Feature> leave_edge(const EdgeRegion& region,
                                                       const Feature& edge,
                                                       const Vec3& p) noexcept {
  const Vec3 from_tail = p - region.tail;
  if (dot(from_tail, region.along) < 0) return Feature::vertex(edge.id);
  if (dot(p - region.head, region.along) > 0) return Feature::vertex(edge.head);
  const double left = dot(from_tail, region.into_left);
  const double right = dot(from_tail, region.into_right);
  if (left > 0 && left >= right) return Feature::face(edge.left);
  if (right > 0) return Feature::face(edge.right);
  return std::nullopt;
}

/// The side of face `f` beyond which `p` lies; of several the nearest one, for then the face's
/// nearest point to `p` lies on it, and no walk that goes on there comes farther away. (The side
/// that `p` is farthest beyond may be another where the face is a needle: walks went round.)
template <typename Body>
[[nodiscard]] std::optional<Feature> leave_face(const Body& body,
                                                std::uint32_t f,
                                                const Vec3& p) noexcept {
  const std::span<const VoronoiFeatures::Side> sides = body.features->sides(f);
  const Vec3 normal = body.normal(f);
  double least = std::numeric_limits<double>::infinity();
  std::size_t slot = sides.size();
  Vec3 corner = body.vertex(sides.back().corner);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vec3 next = body.vertex(sides[i].corner);
    const Vec3 along = next - corner;
    const Vec3 from_corner = p - corner;
    if (dot(cross(normal, along), from_corner) < 0) {
      const double t = unit_clamp(dot(from_corner, along) / squared_length(along));
      const double squared = squared_length(from_corner - along * t);
      if (squared < least) {
        least = squared;
        slot = i;
      }
    }
    corner = next;
  }
  if (slot == sides.size()) return std::nullopt;
  return body.features->side_edge(f, slot == 0 ? sides.size() - 1 : slot - 1);
}

/// Height of `p` over the plane of face `f`; positive is outside. In units of the normal's length.
template <typename Body>
[[nodiscard]] double height_over(const Body& body, std::uint32_t f, const Vec3& p) noexcept {
  return dot(body.normal(f), p - body.vertex(body.features->sides(f).front().corner));
}

}  // namespace carpus::convex
