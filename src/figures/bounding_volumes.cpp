// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/bounding_volumes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/text_format.hpp"
#include "drawing/facets.hpp"
#include "drawing/svg.hpp"
#include "hull/planar_hull.hpp"

namespace carpus::figures {
namespace {

using Polygon = std::vector<Vec2>;

double area_of(const Polygon& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2& a = p[i];
    const Vec2& b = p[(i + 1) % p.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

double along(const Vec2& p, const Vec2& direction) { return p.x * direction.x + p.y * direction.y; }

/// What of a polygon lies where along(p, normal) <= offset.
Polygon cut(const Polygon& polygon, const Vec2& normal, double offset) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    const double from = along(a, normal) - offset;
    const double to = along(b, normal) - offset;
    if (from <= 0) kept.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      const double t = from / (from - to);
      kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return kept;
}

/// The polygon whose `sides` edges have evenly spread normals, the first one turned by `turn`.
Polygon around(const Polygon& hull, std::size_t sides, double turn) {
  constexpr double kFar = 1e4;  // mm; beyond any bone
  Polygon shape{{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {-kFar, kFar}};
  for (std::size_t s = 0; s < sides; ++s) {
    const double angle =
        turn + 2 * std::numbers::pi * static_cast<double>(s) / static_cast<double>(sides);
    const Vec2 normal{std::cos(angle), std::sin(angle)};
    double most = -std::numeric_limits<double>::max();
    for (const Vec2& p : hull) most = std::max(most, along(p, normal));
    shape = cut(shape, normal, most);
  }
  return shape;
}

struct Circle {
  Vec2 centre;
  double radius = std::numeric_limits<double>::max();
};

bool holds(const Circle& c, const Polygon& points) {
  return std::all_of(points.begin(), points.end(), [&](const Vec2& p) {
    return std::hypot(p.x - c.centre.x, p.y - c.centre.y) <= c.radius * (1 + 1e-9);
  });
}

Circle through(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double d = 2 * (a.x * (b.y - c.y) + b.x * (c.y - a.y) + c.x * (a.y - b.y));
  if (d == 0) return {};
  const double aa = a.x * a.x + a.y * a.y;
  const double bb = b.x * b.x + b.y * b.y;
  const double cc = c.x * c.x + c.y * c.y;
  const Vec2 m{(aa * (b.y - c.y) + bb * (c.y - a.y) + cc * (a.y - b.y)) / d,
               (aa * (c.x - b.x) + bb * (a.x - c.x) + cc * (b.x - a.x)) / d};
  return {m, std::hypot(a.x - m.x, a.y - m.y)};
}

/// By trying: the least circle goes through two opposite corners or through three.
Circle least_circle(const Polygon& hull) {
  Circle best;
  const auto consider = [&](const Circle& c) {
    if (c.radius < best.radius && holds(c, hull)) best = c;
  };
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      const Vec2 m{(hull[i].x + hull[j].x) / 2, (hull[i].y + hull[j].y) / 2};
      consider({m, std::hypot(hull[i].x - m.x, hull[i].y - m.y)});
      for (std::size_t k = j + 1; k < hull.size(); ++k) {
        consider(through(hull[i], hull[j], hull[k]));
      }
    }
  }
  return best;
}

/// An edge of the least box lies on an edge of the hull.
Polygon least_box(const Polygon& hull) {
  Polygon best;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2& a = hull[i];
    const Vec2& b = hull[(i + 1) % hull.size()];
    Polygon box = around(hull, 4, std::atan2(b.y - a.y, b.x - a.x));
    if (const double area = area_of(box); area < least) {
      least = area;
      best = std::move(box);
    }
  }
  return best;
}

}  // namespace

std::vector<BoundingShape> bounding_shapes(std::span<const Vec2> points) {
  const auto found = hull::build_planar_hull(points, hull::PlanarAlgorithm::Fast);
  if (found.status != hull::HullStatus::Ok) {
    throw InvalidInput("bounding shapes want at least three points that are not on one line");
  }
  Polygon hull;
  for (const std::uint32_t c : found.corners) hull.push_back(points[c]);
  const Circle circle = least_circle(hull);
  Polygon round;
  constexpr int kCorners = 180;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    round.push_back({circle.centre.x + circle.radius * std::cos(angle),
                     circle.centre.y + circle.radius * std::sin(angle)});
  }
  std::vector<BoundingShape> shapes{{"sphere", round, 0},
                                    {"box along the axes (AABB)", around(hull, 4, 0), 0},
                                    {"box of any direction (OBB)", least_box(hull), 0},
                                    {"fixed directions (8-DOP)", around(hull, 8, 0), 0},
                                    {"convex hull", hull, 0}};
  for (BoundingShape& shape : shapes) shape.area = area_of(shape.outline);
  shapes[0].area = std::numbers::pi * circle.radius * circle.radius;
  return shapes;
}

std::string draw_bounding_volumes(std::span<const Vec2> points) {
  constexpr double kPanel = 240;
  const std::vector<BoundingShape> shapes = bounding_shapes(points);
  Vec2 low = shapes[0].outline[0];
  Vec2 high = low;
  for (const BoundingShape& shape : shapes) {
    for (const Vec2& p : shape.outline) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const double scale = (kPanel - 30) / std::max(high.x - low.x, high.y - low.y);
  std::string svg;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double left = static_cast<double>(i) * kPanel;
    const auto on_page = [&](const Vec2& p) {
      return Vec2{left + kPanel / 2 + (p.x - (low.x + high.x) / 2) * scale,
                  kPanel / 2 - (p.y - (low.y + high.y) / 2) * scale};
    };
    std::vector<Vec2> dots;
    for (const Vec2& p : points) dots.push_back(on_page(p));
    std::vector<Vec2> outline;
    for (const Vec2& p : shapes[i].outline) outline.push_back(on_page(p));
    const double more = 100 * (shapes[i].area / shapes.back().area - 1);
    svg += drawing::draw_points(dots, {0.80, 0.72, 0.55}) +
           drawing::strokes(drawing::polygon_path(outline), {"#1f4fa8", 2}) +
           drawing::text_at(left + kPanel / 2, kPanel + 16, shapes[i].name,
                            {.anchor = drawing::Anchor::Middle, .size = 14}) +
           drawing::text_at(left + kPanel / 2, kPanel + 36,
                            i + 1 == shapes.size() ? format("%.0f mm²", shapes[i].area)
                                                   : format("%.0f %% more area", more),
                            {.anchor = drawing::Anchor::Middle, .size = 13});
  }
  return drawing::page(kPanel * static_cast<double>(shapes.size()), kPanel + 52, svg);
}

}  // namespace carpus::figures
