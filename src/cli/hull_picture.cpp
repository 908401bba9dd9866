// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/hull_picture.hpp"

#include <algorithm>
#include <cstddef>

#include "cli/canvas.hpp"
#include "hull/merged_faces.hpp"

namespace carpus::cli {
namespace {

constexpr std::uint32_t kSize = 900;
constexpr double kMargin = 40;  ///< pixels around the drawing
constexpr PixelArea kArea{kMargin, kMargin, kSize - 2 * kMargin, kSize - 2 * kMargin};
constexpr Colour kBone{0.87, 0.80, 0.66};
constexpr Colour kHull{0.35, 0.60, 1.00};
constexpr Colour kEdge{0.08, 0.20, 0.50};
constexpr double kHullOpacity = 0.22;
constexpr double kEdgeOpacity = 0.5;

void draw_object(Canvas& canvas, const View& view, const TriangleMesh& object) {
  for (const Triangle& t : object.facets) {
    const Vec3& a = object.vertices[t[0]];
    const Vec3& b = object.vertices[t[1]];
    const Vec3& c = object.vertices[t[2]];
    Vec3 normal = normalized_or(cross(b - a, c - a), {0, 0, 1});
    if (!view.faces_viewer(normal)) normal = -normal;  // open surfaces show their inside
    const Colour colour = shaded(kBone, view.brightness(normal));
    canvas.fill(view(a), view(b), view(c),
                [&](int x, int y, double z) { canvas.plot(x, y, z, colour); });
  }
  if (!object.facets.empty()) return;
  for (const Vec3& p : object.vertices) canvas.dot(view(p), shaded(kBone, 0.7));
}

}  // namespace

Picture draw_hull(const TriangleMesh& object, const ConvexPolytope& hull) {
  Canvas canvas(kSize, kSize);
  const View view(hull.vertices, kArea);
  draw_object(canvas, view, object);
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const Vec3& normal = hull.planes[f].normal;
    if (!view.faces_viewer(normal)) continue;
    const Triangle& t = hull.facets[f];
    const Colour colour = shaded(kHull, view.brightness(normal));
    canvas.fill(view(hull.vertices[t[0]]), view(hull.vertices[t[1]]), view(hull.vertices[t[2]]),
                [&](int x, int y, double) { canvas.blend(x, y, colour, kHullOpacity); });
  }
  const std::vector<hull::PolygonalFace> faces = hull::merged_faces(hull);
  const auto is_seen = [&](std::uint32_t face) {
    return view.faces_viewer(hull.planes[faces[face].facets[0]].normal);
  };
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const hull::PolygonalFace& face = faces[i];
    for (std::size_t e = 0; e < face.corners.size(); ++e) {
      const bool other_draws = face.neighbours[e] < i && is_seen(face.neighbours[e]);
      if (!is_seen(i) || other_draws) continue;
      const std::uint32_t next = face.corners[(e + 1) % face.corners.size()];
      canvas.line(view(hull.vertices[face.corners[e]]), view(hull.vertices[next]), kEdge,
                  kEdgeOpacity);
    }
  }
  return canvas.picture();
}

Picture draw_planar_hull(std::span<const Vec2> points, std::span<const std::uint32_t> corners) {
  Canvas canvas(kSize, kSize);
  Vec2 low = points[corners[0]];
  Vec2 high = low;
  for (const std::uint32_t c : corners) {
    low = {std::min(low.x, points[c].x), std::min(low.y, points[c].y)};
    high = {std::max(high.x, points[c].x), std::max(high.y, points[c].y)};
  }
  const double scale = (kSize - 2 * kMargin) / std::max(high.x - low.x, high.y - low.y);
  const auto view = [&](std::uint32_t i) {
    return Vec3{kSize / 2.0 + (points[i].x - low.x - (high.x - low.x) / 2) * scale,
                kSize / 2.0 - (points[i].y - low.y - (high.y - low.y) / 2) * scale, 0};
  };
  for (std::uint32_t i = 0; i < points.size(); ++i) canvas.dot(view(i), shaded(kBone, 0.6));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    canvas.line(view(corners[i]), view(corners[(i + 1) % corners.size()]), kHull, 1);
  }
  return canvas.picture();
}

}  // namespace carpus::cli
