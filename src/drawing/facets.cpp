// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "drawing/facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/text_format.hpp"

namespace carpus::drawing {
namespace {

/// Without soft edges: neighbours share their border's pixels, and no seam of paper shows between.
constexpr const char* kCrisp = "<g shape-rendering=\"crispEdges\" fill-opacity=\"%.3g\">\n";

std::string filled(const std::string& path, const Colour& colour) {
  return "<path fill=\"" + hex(colour) + "\" d=\"" + path + "\"/>\n";
}

}  // namespace

std::string draw_faces(const View& view, const Solid& solid, const Colour& colour, double opacity) {
  std::string svg = format(kCrisp, opacity);
  std::vector<Vec2> corners;
  for (const Face& face : solid.faces) {
    if (!view.faces_viewer(face.normal)) continue;
    corners.clear();
    for (const std::uint32_t c : face.corners) corners.push_back(view(solid.corners[c]));
    svg += filled(polygon_path(corners), shaded(colour, view.brightness(face.normal)));
  }
  return svg + "</g>\n";
}

std::string draw_edges(const View& view, const Solid& solid, const Colour& colour, double opacity) {
  std::string inner;
  std::string outline;
  const auto is_seen = [&](std::uint32_t face) {
    return view.faces_viewer(solid.faces[face].normal);
  };
  for (std::uint32_t i = 0; i < solid.faces.size(); ++i) {
    const Face& face = solid.faces[i];
    for (std::size_t e = 0; is_seen(i) && e < face.corners.size(); ++e) {
      const std::uint32_t other = face.neighbours[e];
      if (other < i && is_seen(other)) continue;  // drawn already
      const std::uint32_t next = face.corners[(e + 1) % face.corners.size()];
      (is_seen(other) ? inner : outline) +=
          line_path(view(solid.corners[face.corners[e]]), view(solid.corners[next]));
    }
  }
  const std::string ink = hex(colour);
  return strokes(inner, {ink, 1, opacity}) + strokes(outline, {ink, 2});
}

std::string draw_surface(const View& view, const TriangleMesh& surface, const SurfacePaint& paint) {
  const bool is_closed = check_surface(surface) == SurfaceStatus::Ok;
  std::vector<std::pair<double, std::string>> facets;
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const Triangle& t = surface.facets[f];
    const std::array corners{surface.vertices[t[0]], surface.vertices[t[1]],
                             surface.vertices[t[2]]};
    Vec3 normal = normalized_or(cross(corners[1] - corners[0], corners[2] - corners[0]), {0, 0, 1});
    if (!view.faces_viewer(normal)) {
      if (is_closed) continue;
      normal = -normal;
    }
    const std::array on_page{view(corners[0]), view(corners[1]), view(corners[2])};
    facets.emplace_back(
        view.nearness(corners[0] + corners[1] + corners[2]),
        filled(polygon_path(on_page), shaded(paint.colour(f), view.brightness(normal))));
  }
  std::stable_sort(facets.begin(), facets.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string svg = "<g stroke=\"" + std::string(paint.edges) +
                    format("\" stroke-width=\"%.3g\">\n", paint.edge_width) + format(kCrisp, 1.0);
  for (const auto& facet : facets) svg += facet.second;
  return svg + "</g>\n</g>\n";
}

std::string draw_surface(const View& view, const TriangleMesh& surface, const Colour& colour) {
  return draw_surface(view, surface, {[&](std::size_t) { return colour; }});
}

std::string draw_points(std::span<const Vec2> on_page, const Colour& colour) {
  std::vector<std::pair<long, long>> places;
  places.reserve(on_page.size());
  for (const Vec2& p : on_page) places.emplace_back(std::lround(p.y), std::lround(p.x));
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::string path;
  for (const auto& [y, x] : places) path += format("M%ld %ldh0", x, y);
  if (path.empty()) return {};
  return "<path stroke=\"" + hex(colour) + "\" stroke-width=\"3\" stroke-linecap=\"square\" d=\"" +
         path + "\"/>\n";
}

}  // namespace carpus::drawing
