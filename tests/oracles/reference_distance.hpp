// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Distance and penetration depth of two bodies in long double, found the slow way. The distance
// comes with a proof: a point of each body (an upper bound) and a slab between them (a lower one).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "oracles/separating_axes.hpp"

namespace carpus::oracles {

using Long3 = Triple<long double>;

struct DistanceBounds {
  long double lower_mm = 0;  ///< 0 where no slab was found between the bodies
  long double upper_mm = 0;
};

namespace detail {

/// The point of least norm on the plane through the given points, or false where its weights are
/// not all positive. Solved for the differences to the first point, by elimination with pivots.
inline bool interior_minimum(const std::vector<Long3>& p, Long3& nearest) {
  const std::size_t m = p.size() - 1;
  std::vector<Long3> d;
  for (std::size_t i = 1; i <= m; ++i) d.push_back(minus(p[i], p[0]));
  std::vector<std::vector<long double>> a(m, std::vector<long double>(m + 1, 0));
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < m; ++j) a[i][j] = dot_of(d[i], d[j]);
    a[i][m] = -dot_of(d[i], p[0]);
  }
  for (std::size_t k = 0; k < m; ++k) {
    std::size_t best = k;
    for (std::size_t i = k; i < m; ++i) {
      if (std::abs(a[i][k]) > std::abs(a[best][k])) best = i;
    }
    if (a[best][k] == 0) return false;
    std::swap(a[k], a[best]);
    for (std::size_t i = 0; i < m; ++i) {
      if (i == k) continue;
      const long double f = a[i][k] / a[k][k];
      for (std::size_t j = k; j <= m; ++j) a[i][j] -= f * a[k][j];
    }
  }
  long double first = 1;
  nearest = p[0];
  for (std::size_t i = 0; i < m; ++i) {
    const long double w = a[i][m] / a[i][i];
    if (!(w > 0)) return false;
    first -= w;
    for (std::size_t k = 0; k < 3; ++k) nearest[k] += w * d[i][k];
  }
  return first > 0;
}

/// The nearest point to the origin of the hull of at most four points, which are reduced to those
/// that carry it.
inline Long3 nearest_of_simplex(std::vector<Long3>& simplex) {
  Long3 best{};
  long double least = 1e300L;
  std::vector<Long3> carrier;
  for (std::size_t subset = 1; subset < (std::size_t{1} << simplex.size()); ++subset) {
    std::vector<Long3> p;
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      if ((subset >> i & 1U) != 0) p.push_back(simplex[i]);
    }
    Long3 x;
    if (!interior_minimum(p, x)) continue;
    if (dot_of(x, x) < least) {
      least = dot_of(x, x);
      best = x;
      carrier = p;
    }
  }
  simplex = carrier;
  return best;
}

}  // namespace detail

/// Gilbert's algorithm with a full scan for every support point. O(vertices) a step.
inline DistanceBounds reference_distance(const Body<long double>& a, const Body<long double>& b) {
  constexpr int kMostSteps = 400;
  std::vector<Long3> simplex{minus(a.vertices[0], b.vertices[0])};
  DistanceBounds bounds{0, 1e300L};
  for (int step = 0; step < kMostSteps; ++step) {
    const Long3 x = detail::nearest_of_simplex(simplex);
    const long double norm = std::sqrt(dot_of(x, x));
    bounds.upper_mm = std::min(bounds.upper_mm, norm);
    if (norm == 0 || simplex.empty()) break;
    const auto along = [&](const Long3& v, const Long3& w) { return dot_of(x, v) < dot_of(x, w); };
    const Long3 low = *std::min_element(a.vertices.begin(), a.vertices.end(), along);
    const Long3 high = *std::max_element(b.vertices.begin(), b.vertices.end(), along);
    const Long3 w = minus(low, high);
    const long double slab = dot_of(x, w) / norm;
    bounds.lower_mm = std::max(bounds.lower_mm, slab);
    if (norm - slab < 1e-16L * norm || simplex.size() == 4) break;
    if (std::find(simplex.begin(), simplex.end(), w) != simplex.end()) break;
    simplex.push_back(w);
  }
  return bounds;
}

namespace detail {

/// An edge of a body: its ends, and the normals of the facets to either side.
struct ArcEdge {
  Long3 point;
  Long3 direction;
  Long3 left;
  Long3 right;
};

inline std::vector<ArcEdge> edges_with_normals(const Body<long double>& body,
                                               const ConvexPolytope& shape,
                                               long double sign) {
  std::vector<ArcEdge> edges;
  const auto signed_normal = [&](std::size_t f) {
    Long3 n = body.normals[f];
    for (long double& x : n) x *= sign;
    return n;
  };
  for (std::size_t f = 0; f < shape.facets.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t g = shape.neighbours[f][i];
      if (g < f) continue;
      const Long3& p = body.vertices[shape.facets[f][i]];
      const Long3& q = body.vertices[shape.facets[f][(i + 1) % 3]];
      edges.push_back({p, minus(q, p), signed_normal(f), signed_normal(g)});
    }
  }
  return edges;
}

}  // namespace detail

/// The shortest translation that parts two bodies that meet: the least overlap along any normal of
/// the Minkowski difference: facets of either body, and pairs of edges whose arcs of normals cross.
/// O(facets * vertices + edges^2).
inline long double reference_depth(const Body<long double>& a,
                                   const ConvexPolytope& a_shape,
                                   const Body<long double>& b,
                                   const ConvexPolytope& b_shape) {
  long double least = 1e300L;
  const auto overlap = [&](const Long3& n) {
    long double high = -1e300L;
    long double low = 1e300L;
    for (const Long3& v : a.vertices) high = std::max(high, dot_of(n, v));
    for (const Long3& v : b.vertices) low = std::min(low, dot_of(n, v));
    return (high - low) / std::sqrt(dot_of(n, n));
  };
  for (const Long3& n : a.normals) least = std::min(least, overlap(n));
  for (const Long3& n : b.normals) least = std::min(least, overlap({-n[0], -n[1], -n[2]}));
  const auto first = detail::edges_with_normals(a, a_shape, 1);
  const auto second = detail::edges_with_normals(b, b_shape, -1);
  for (const detail::ArcEdge& e : first) {
    for (const detail::ArcEdge& f : second) {
      // The arc of e crosses the plane of f's arc, whose normal is f's direction, and the other way
      // round; a slightly generous test lets only more candidates through.
      const long double e1 = dot_of(e.left, f.direction);
      const long double e2 = dot_of(e.right, f.direction);
      if (e1 * e2 > 0) continue;
      const long double f1 = dot_of(f.left, e.direction);
      const long double f2 = dot_of(f.right, e.direction);
      if (f1 * f2 > 0) continue;
      Long3 n = cross_of(e.direction, f.direction);
      const long double size = std::sqrt(dot_of(n, n));
      if (!(size > 1e-12L)) continue;
      Long3 middle = e.left;
      for (std::size_t k = 0; k < 3; ++k) middle[k] += e.right[k];
      if (dot_of(n, middle) < 0) n = {-n[0], -n[1], -n[2]};
      if (dot_of(n, minus(e.point, f.point)) / size < least) least = std::min(least, overlap(n));
    }
  }
  return least;
}

}  // namespace carpus::oracles
