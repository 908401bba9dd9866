// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/features/voronoi_features.hpp"

#include <algorithm>

#include "geometry/exact_number.hpp"

namespace carpus::convex {
namespace {

/// Sum of the cross products about the first corner: of all vectors the one along which the polygon
/// shows the largest area. In exact numbers, and from the body's vertices, not from those about the
/// centre: where a vertex lies on an edge but for rounding, doubles would give a sliver's normal
/// any direction.
Vec3 normal_of(const ConvexBody& body, const hull::PolygonalFace& face) {
  const std::span<const Vec3> vertices = body.vertices();
  const ExactVec3 origin(vertices[face.corners[0]]);
  ExactVec3 sum(Vec3{});
  ExactVec3 last = ExactVec3(vertices[face.corners[1]]) - origin;
  for (std::size_t i = 2; i < face.corners.size(); ++i) {
    const ExactVec3 next = ExactVec3(vertices[face.corners[i]]) - origin;
    sum = sum + cross(last, next);
    last = next;
  }
  return normalized_or(rounded_direction(sum), body.polytope().planes[face.facets.front()].normal);
}

Plane plane_of(std::span<const Vec3> vertices,
               const ConvexBody& body,
               const hull::PolygonalFace& face) {
  Plane plane;
  plane.normal = normal_of(body, face);
  plane.offset = dot(plane.normal, vertices[face.corners[0]]);
  for (const std::uint32_t v : face.corners) {
    plane.offset = std::max(plane.offset, dot(plane.normal, vertices[v]));
  }
  return plane;
}

}  // namespace

VoronoiFeatures::VoronoiFeatures(const ConvexBody& body, const Vec3& centre)
    : interior_point_(body.interior_point() - centre), centre_(centre) {
  for (const Vec3& v : body.vertices()) {
    vertices_.push_back(v - centre);
    radius_mm_ = std::max(radius_mm_, length(vertices_.back()));
  }
  spoke_starts_.push_back(0);
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    const std::span<const std::uint32_t> ends = body.vertex_neighbours(v);
    const std::span<const std::uint32_t> faces = body.vertex_faces(v);
    for (std::size_t i = 0; i < ends.size(); ++i) spokes_.push_back({ends[i], faces[i]});
    spoke_starts_.push_back(static_cast<std::uint32_t>(spokes_.size()));
  }
  side_starts_.push_back(0);
  for (const hull::PolygonalFace& face : body.faces()) {
    planes_.push_back(plane_of(vertices_, body, face));
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      sides_.push_back({face.corners[i], face.neighbours[i]});
    }
    side_starts_.push_back(static_cast<std::uint32_t>(sides_.size()));
  }
}

}  // namespace carpus::convex
