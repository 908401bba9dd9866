// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A canvas of depths: triangles are filled pixel by pixel with interpolated depth, nearest wins.
#include "cli/hull_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "geometry/aabb.hpp"
#include "hull/merged_faces.hpp"

namespace carpus::cli {
namespace {

constexpr std::uint32_t kSize = 900;
constexpr double kMargin = 40;  ///< pixels around the drawing
using Colour = std::array<double, 3>;
constexpr Colour kPaper{1, 1, 1};
constexpr Colour kBone{0.87, 0.80, 0.66};
constexpr Colour kHull{0.35, 0.60, 1.00};
constexpr Colour kEdge{0.08, 0.20, 0.50};
constexpr double kHullOpacity = 0.22;
constexpr double kEdgeOpacity = 0.5;

/// x and y in pixels, y down; z towards the viewer, in pixels too.
class Canvas {
 public:
  Canvas()
      : colour_(std::size_t{kSize} * kSize, kPaper),
        depth_(colour_.size(), -std::numeric_limits<double>::infinity()) {}

  /// Nearest wins; opaque.
  void plot(int x, int y, double z, const Colour& c) {
    if (!is_inside(x, y) || z <= depth_[at(x, y)]) return;
    depth_[at(x, y)] = z;
    colour_[at(x, y)] = c;
  }
  void blend(int x, int y, const Colour& c, double opacity) {
    if (!is_inside(x, y)) return;
    for (std::size_t i = 0; i < 3; ++i) {
      double& value = colour_[at(x, y)][i];
      value += opacity * (c[i] - value);
    }
  }

  /// Calls pixel(x, y, z) for each pixel whose centre is in the triangle.
  template <typename Pixel>
  static void fill(const Vec3& a, const Vec3& b, const Vec3& c, Pixel pixel) {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) return;
    const auto range = [](double u, double v, double w) {
      return std::array{
          std::max(0, static_cast<int>(std::floor(std::min({u, v, w})))),
          std::min(static_cast<int>(kSize) - 1, static_cast<int>(std::ceil(std::max({u, v, w}))))};
    };
    const auto [x0, x1] = range(a.x, b.x, c.x);
    const auto [y0, y1] = range(a.y, b.y, c.y);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
        const double v = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
        const double w = 1 - u - v;
        if (u >= 0 && v >= 0 && w >= 0) pixel(x, y, u * a.z + v * b.z + w * c.z);
      }
    }
  }

  void line(const Vec3& a, const Vec3& b, const Colour& c, double opacity) {
    const double steps = std::ceil(std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1.0}));
    for (double i = 0; i < steps; ++i) {  // the last pixel belongs to the next line
      const Vec3 p = a + (b - a) * (i / steps);
      blend(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)), c, opacity);
    }
  }

  void dot(const Vec3& p, const Colour& c) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        plot(static_cast<int>(std::lround(p.x)) + dx, static_cast<int>(std::lround(p.y)) + dy, p.z,
             c);
      }
    }
  }

  [[nodiscard]] Picture picture() const {
    Picture result{kSize, kSize, {}};
    result.rgb.reserve(3 * colour_.size());
    for (const Colour& c : colour_) {
      for (const double v : c) {
        result.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))));
      }
    }
    return result;
  }

 private:
  static bool is_inside(int x, int y) {
    return x >= 0 && y >= 0 && x < static_cast<int>(kSize) && y < static_cast<int>(kSize);
  }
  static std::size_t at(int x, int y) {
    return static_cast<std::size_t>(y) * kSize + static_cast<std::size_t>(x);
  }
  std::vector<Colour> colour_;
  std::vector<double> depth_;
};

/// Turns points to the viewer and fits what is to be seen into the canvas.
class View {
 public:
  explicit View(std::span<const Vec3> seen) {
    std::vector<Vec3> turned;
    turned.reserve(seen.size());
    for (const Vec3& p : seen) turned.push_back(turn(p));
    const Aabb box = bounds_of(turned);
    const Vec3 size = box.extent();
    const double largest = std::max({size.x, size.y, std::numeric_limits<double>::min()});
    scale_ = (kSize - 2 * kMargin) / largest;
    centre_ = box.low + size * 0.5;
  }
  [[nodiscard]] Vec3 operator()(const Vec3& p) const {
    const Vec3 d = (turn(p) - centre_) * scale_;
    return {kSize / 2.0 + d.x, kSize / 2.0 - d.y, d.z};
  }
  /// 0 to 1: how bright a facet is that a lamp beside the viewer shines on.
  [[nodiscard]] static double brightness(const Vec3& normal) {
    const Vec3 lamp = normalized_or({-0.4, 0.5, 0.77}, {0, 0, 1});
    return 0.45 + 0.55 * std::max(0.0, dot(turn(normal), lamp));
  }
  [[nodiscard]] static bool faces_viewer(const Vec3& normal) { return turn(normal).z > 0; }

 private:
  /// Axes of the view in the Patient frame (LPS): right, up, towards the viewer, who stands in
  /// front (-y), a little to the left (+x) and above (+z).
  static Vec3 turn(const Vec3& p) {
    static const Vec3 kTowards = normalized_or({0.5, -0.8, 0.35}, {0, -1, 0});
    static const Vec3 kRight = normalized_or(cross({0, 0, 1}, kTowards), {1, 0, 0});
    static const Vec3 kUp = cross(kTowards, kRight);
    return {dot(kRight, p), dot(kUp, p), dot(kTowards, p)};
  }
  double scale_ = 1;
  Vec3 centre_;
};

Colour shaded(const Colour& c, double brightness) {
  return {c[0] * brightness, c[1] * brightness, c[2] * brightness};
}

void draw_object(Canvas& canvas, const View& view, const TriangleMesh& object) {
  for (const Triangle& t : object.facets) {
    const Vec3& a = object.vertices[t[0]];
    const Vec3& b = object.vertices[t[1]];
    const Vec3& c = object.vertices[t[2]];
    Vec3 normal = normalized_or(cross(b - a, c - a), {0, 0, 1});
    if (!View::faces_viewer(normal)) normal = -normal;  // open surfaces show their inside
    const Colour colour = shaded(kBone, View::brightness(normal));
    Canvas::fill(view(a), view(b), view(c),
                 [&](int x, int y, double z) { canvas.plot(x, y, z, colour); });
  }
  if (!object.facets.empty()) return;
  for (const Vec3& p : object.vertices) canvas.dot(view(p), shaded(kBone, 0.7));
}

}  // namespace

Picture draw_hull(const TriangleMesh& object, const ConvexPolytope& hull) {
  Canvas canvas;
  const View view(hull.vertices);
  draw_object(canvas, view, object);
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const Vec3& normal = hull.planes[f].normal;
    if (!View::faces_viewer(normal)) continue;
    const Triangle& t = hull.facets[f];
    const Colour colour = shaded(kHull, View::brightness(normal));
    Canvas::fill(view(hull.vertices[t[0]]), view(hull.vertices[t[1]]), view(hull.vertices[t[2]]),
                 [&](int x, int y, double) { canvas.blend(x, y, colour, kHullOpacity); });
  }
  const std::vector<hull::PolygonalFace> faces = hull::merged_faces(hull);
  const auto is_seen = [&](std::uint32_t face) {
    return View::faces_viewer(hull.planes[faces[face].facets[0]].normal);
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
  Canvas canvas;
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
