// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "drawing/facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "core/state_hash.hpp"
#include "core/text_format.hpp"

namespace carpus::drawing {
namespace {

/// Without soft edges: neighbours share their border's pixels, and no seam of paper shows between.
constexpr const char* kCrisp = "<g shape-rendering=\"crispEdges\" fill-opacity=\"%.3g\">\n";

std::string filled(const std::string& path, const Colour& colour) {
  return "<path fill=\"" + hex(colour) + "\" d=\"" + path + "\"/>\n";
}

/// A step of fewer is not seen between neighbours.
constexpr double kSeenStep = 1.0 / 128;

/// A facet whose brightness goes straight from corner to corner, which is a linear gradient on the
/// page. Its name is made of what it is: pictures that share a document may share it.
std::string filled_between(const std::array<Vec2, 3>& corners,
                           const Colour& colour,
                           const std::array<double, 3>& brightness) {
  const auto [least, most] = std::minmax_element(brightness.begin(), brightness.end());
  const std::string path = polygon_path(corners);
  const Colour flat = shaded(colour, (brightness[0] + brightness[1] + brightness[2]) / 3);
  const Vec2 a{corners[1].x - corners[0].x, corners[1].y - corners[0].y};
  const Vec2 b{corners[2].x - corners[0].x, corners[2].y - corners[0].y};
  const double twice_area = a.x * b.y - a.y * b.x;
  if (*most - *least < kSeenStep || std::abs(twice_area) < 1e-6) return filled(path, flat);
  const double u = brightness[1] - brightness[0];
  const double v = brightness[2] - brightness[0];
  const Vec2 slope{(u * b.y - v * a.y) / twice_area, (v * a.x - u * b.x) / twice_area};
  const double steep = slope.x * slope.x + slope.y * slope.y;
  const Vec2& from = corners[static_cast<std::size_t>(least - brightness.begin())];
  const double along = (*most - *least) / steep;
  const std::string gradient = format(
      "gradientUnits=\"userSpaceOnUse\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"><stop "
      "stop-color=\"%s\"/><stop offset=\"1\" stop-color=\"%s\"/>",
      from.x, from.y, from.x + slope.x * along, from.y + slope.y * along,
      hex(shaded(colour, *least)).c_str(), hex(shaded(colour, *most)).c_str());
  StateHash hash;
  hash.add_bytes(std::as_bytes(std::span(gradient)));
  const std::string id = format("g%llx", static_cast<unsigned long long>(hash.value()));
  return "<linearGradient id=\"" + id + "\" " + gradient + "</linearGradient><path fill=\"url(#" +
         id + ")\" d=\"" + path + "\"/>\n";
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
    std::array<double, 3> brightness{};
    for (std::size_t k = 0; k < 3; ++k) {
      brightness[k] = view.brightness(paint.normals.empty() ? normal : paint.normals[t[k]]);
      if (!paint.factors.empty()) brightness[k] *= paint.factors[f][k];
    }
    facets.emplace_back(view.nearness(corners[0] + corners[1] + corners[2]),
                        filled_between(on_page, paint.colour(f), brightness));
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
