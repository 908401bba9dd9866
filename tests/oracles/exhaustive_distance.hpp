// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The distance of two convex polytopes that are apart: the least over all pairs of a vertex and a
// facet, and of two edges. In long double, with no memory and no walk.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/convex_polytope.hpp"
#include "oracles/separating_axes.hpp"

namespace carpus::oracles {

using Point3 = Triple<long double>;

inline Point3 along(const Point3& a, const Point3& u, long double t) {
  return {a[0] + u[0] * t, a[1] + u[1] * t, a[2] + u[2] * t};
}

inline long double length_of(const Point3& a) { return std::sqrt(dot_of(a, a)); }

inline long double distance_to_segment(const Point3& p, const Point3& a, const Point3& b) {
  const Point3 u = minus(b, a);
  const long double t = std::clamp(dot_of(minus(p, a), u) / dot_of(u, u), 0.0L, 1.0L);
  return length_of(minus(p, along(a, u, t)));
}

/// Nearest points of two segments: inner ones of both where the lines have them, else an end.
inline long double distance_of_segments(const Point3& a,
                                        const Point3& b,
                                        const Point3& c,
                                        const Point3& d) {
  long double best = std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d),
                               distance_to_segment(c, a, b), distance_to_segment(d, a, b)});
  const Point3 u = minus(b, a);
  const Point3 v = minus(d, c);
  const Point3 n = cross_of(u, v);
  const long double squared = dot_of(n, n);
  if (squared > 0) {
    const Point3 r = minus(c, a);
    const long double s = dot_of(cross_of(r, v), n) / squared;
    const long double t = dot_of(cross_of(r, u), n) / squared;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      best = std::min(best, length_of(minus(along(a, u, s), along(c, v, t))));
    }
  }
  return best;
}

/// Height over a triangle seen counter-clockwise from outside; infinite beside or below it.
inline long double height_over_triangle(const Point3& p,
                                        const Point3& a,
                                        const Point3& b,
                                        const Point3& c) {
  const Point3 n = cross_of(minus(b, a), minus(c, a));
  const long double height = dot_of(n, minus(p, a)) / length_of(n);
  const bool inside = dot_of(cross_of(n, minus(b, a)), minus(p, a)) >= 0 &&
                      dot_of(cross_of(n, minus(c, b)), minus(p, b)) >= 0 &&
                      dot_of(cross_of(n, minus(a, c)), minus(p, c)) >= 0;
  return inside && height >= 0 ? height : std::numeric_limits<long double>::infinity();
}

/// Vertices in common coordinates, triangles as given.
struct PlacedPolytope {
  const ConvexPolytope* polytope;
  std::vector<Point3> vertices;
};

inline PlacedPolytope place(const ConvexPolytope& polytope,
                            const Mat3& rotation,
                            const Vec3& translation) {
  return {&polytope, body_of<long double>(polytope, rotation, translation).vertices};
}

/// Of polytopes that do not meet (see separation()). O(edges^2 + vertices * facets).
inline long double exhaustive_distance(const PlacedPolytope& a, const PlacedPolytope& b) {
  long double best = std::numeric_limits<long double>::infinity();
  const auto over_facets = [&](const PlacedPolytope& of, const PlacedPolytope& points) {
    for (const Triangle& t : of.polytope->facets) {
      for (const Point3& p : points.vertices) {
        best = std::min(
            best, height_over_triangle(p, of.vertices[t[0]], of.vertices[t[1]], of.vertices[t[2]]));
      }
    }
  };
  over_facets(a, b);
  over_facets(b, a);
  const auto edges_of = [](const PlacedPolytope& of) {
    std::vector<std::array<Point3, 2>> edges;
    for (const Triangle& t : of.polytope->facets) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t tail = t[i];
        const std::uint32_t head = t[(i + 1) % 3];
        if (tail < head) edges.push_back({of.vertices[tail], of.vertices[head]});
      }
    }
    return edges;
  };
  const auto edges_b = edges_of(b);
  for (const auto& e : edges_of(a)) {
    for (const auto& f : edges_b) {
      best = std::min(best, distance_of_segments(e[0], e[1], f[0], f[1]));
    }
  }
  return best;
}

}  // namespace carpus::oracles
