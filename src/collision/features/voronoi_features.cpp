// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/features/voronoi_features.hpp"

#include <algorithm>

namespace carpus::collision {
namespace {

/// Sum of the cross products about the first corner: of all vectors the one along which the polygon
/// shows the largest area, hence insensitive to slivers among its triangles.
Plane plane_of(std::span<const Vec3> vertices,
               const ConvexPolytope& polytope,
               const hull::PolygonalFace& face) {
  const Vec3& origin = vertices[face.corners[0]];
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < face.corners.size(); ++i) {
    sum += cross(vertices[face.corners[i]] - origin, vertices[face.corners[i + 1]] - origin);
  }
  Plane plane;
  plane.normal = normalized_or(sum, polytope.planes[face.facets.front()].normal);
  plane.offset = dot(plane.normal, origin);
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
    planes_.push_back(plane_of(vertices_, body.polytope(), face));
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
      sides_.push_back({face.corners[i], face.neighbours[i]});
    }
    side_starts_.push_back(static_cast<std::uint32_t>(sides_.size()));
  }
}

}  // namespace carpus::collision
