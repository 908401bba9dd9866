// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces on a page: facets that a lamp shades, edges whose outline is bolder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drawing/view.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::drawing {

/// A flat convex face of a solid whose corners are counterclockwise from outside.
struct Face {
  std::span<const std::uint32_t> corners;
  /// The face beyond the edge from corner i to the next, as an index into the solid's faces.
  std::span<const std::uint32_t> neighbours;
  Vec3 normal;  ///< outward, unit
};

/// A convex solid; spans must outlive it.
struct Solid {
  std::span<const Vec3> corners;  ///< where they are seen [mm]
  std::vector<Face> faces;
};

/// The faces that the viewer sees. They hide nothing of each other, so that their order is free.
[[nodiscard]] std::string draw_faces(const View& view,
                                     const Solid& solid,
                                     const Colour& colour,
                                     double opacity = 1);

/// Each seen edge once; those between a seen and a hidden face, the outline, opaque and twice as
/// wide.
/// @param opacity  of the others, which lie within the outline.
[[nodiscard]] std::string draw_edges(const View& view,
                                     const Solid& solid,
                                     const Colour& colour,
                                     double opacity);

/// How each facet of a surface is painted.
struct SurfacePaint {
  std::function<Colour(std::size_t facet)> colour;
  std::string_view edges = "none";  ///< colour of the facets' edges
  double edge_width = 0.5;
  /// By vertex, unit, outward: a facet is shaded from corner to corner [gouraud1971continuous].
  /// Empty: each facet has the shade of its own plane.
  std::span<const Vec3> normals = {};
  /// By facet and corner: how much brighter its colour is there than in the middle. Empty: as
  /// bright.
  std::span<const std::array<double, 3>> factors = {};
};

/// Any surface, from far to near: what is nearer is painted over what is farther, by the middles of
/// the facets, which is right up to facets that are long beside what separates them. Facets that
/// face away are left out where the surface is closed, and shaded from inside where it is not.
[[nodiscard]] std::string draw_surface(const View& view,
                                       const TriangleMesh& surface,
                                       const SurfacePaint& paint);
[[nodiscard]] std::string draw_surface(const View& view,
                                       const TriangleMesh& surface,
                                       const Colour& colour);

/// Points as squares of 3 units; those that would lie on the same square unit are drawn once.
[[nodiscard]] std::string draw_points(std::span<const Vec2> on_page, const Colour& colour);

}  // namespace carpus::drawing
