// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/hull_picture.hpp"

#include <algorithm>
#include <vector>

#include "drawing/facets.hpp"
#include "drawing/svg.hpp"
#include "hull/merged_faces.hpp"

namespace carpus::figures {
namespace {

using drawing::Colour;

constexpr double kSize = 900;
constexpr double kMargin = 40;  ///< around the drawing
constexpr drawing::PageArea kArea{kMargin, kMargin, kSize - 2 * kMargin, kSize - 2 * kMargin};
constexpr Colour kBone{0.87, 0.80, 0.66};
constexpr Colour kHull{0.35, 0.60, 1.00};
constexpr Colour kEdge{0.08, 0.20, 0.50};
constexpr double kHullOpacity = 0.22;
constexpr double kEdgeOpacity = 0.35;

std::string draw_object(const drawing::View& view, const TriangleMesh& object) {
  if (!object.facets.empty()) return draw_surface(view, object, kBone);
  std::vector<Vec2> points;
  points.reserve(object.vertices.size());
  for (const Vec3& p : object.vertices) points.push_back(view(p));
  return drawing::draw_points(points, drawing::shaded(kBone, 0.7));
}

}  // namespace

std::string draw_hull(const TriangleMesh& object, const ConvexPolytope& hull) {
  const drawing::View view(hull.vertices, kArea);
  const std::vector<hull::PolygonalFace> faces = hull::merged_faces(hull);
  drawing::Solid solid{hull.vertices, {}};
  for (const hull::PolygonalFace& face : faces) {
    solid.faces.push_back({face.corners, face.neighbours, hull.planes[face.facets[0]].normal});
  }
  return drawing::page(kSize, kSize,
                       draw_object(view, object) + draw_faces(view, solid, kHull, kHullOpacity) +
                           draw_edges(view, solid, kEdge, kEdgeOpacity));
}

std::string draw_planar_hull(std::span<const Vec2> points, std::span<const std::uint32_t> corners) {
  Vec2 low = points[corners[0]];
  Vec2 high = low;
  for (const std::uint32_t c : corners) {
    low = {std::min(low.x, points[c].x), std::min(low.y, points[c].y)};
    high = {std::max(high.x, points[c].x), std::max(high.y, points[c].y)};
  }
  const double scale = (kSize - 2 * kMargin) / std::max(high.x - low.x, high.y - low.y);
  std::vector<Vec2> on_page;
  on_page.reserve(points.size());
  for (const Vec2& p : points) {
    on_page.push_back({kSize / 2 + (p.x - low.x - (high.x - low.x) / 2) * scale,
                       kSize / 2 - (p.y - low.y - (high.y - low.y) / 2) * scale});
  }
  std::vector<Vec2> outline;
  for (const std::uint32_t c : corners) outline.push_back(on_page[c]);
  return drawing::page(
      kSize, kSize,
      drawing::draw_points(on_page, drawing::shaded(kBone, 0.6)) +
          drawing::strokes(drawing::polygon_path(outline), {drawing::hex(kHull), 2}));
}

}  // namespace carpus::figures
