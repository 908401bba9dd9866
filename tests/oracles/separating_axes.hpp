// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Do two convex polytopes meet? They do not iff one of these axes separates them: a facet normal of
// either, or the cross product of an edge of each [gottschalk1996separating]. All are tried.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

#include "geometry/convex_polytope.hpp"
#include "geometry/mat3.hpp"

namespace carpus::oracles {

/// A vector of a number type in which the test is done: long long is exact for small integers.
template <typename T>
using Triple = std::array<T, 3>;

template <typename T>
Triple<T> cross_of(const Triple<T>& a, const Triple<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <typename T>
T dot_of(const Triple<T>& a, const Triple<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename T>
Triple<T> minus(const Triple<T>& a, const Triple<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <typename T>
struct Body {
  std::vector<Triple<T>> vertices;
  std::vector<Triple<T>> normals;
  std::vector<Triple<T>> edges;
};

/// The polytope with vertices rotation * v + translation, evaluated in T.
template <typename T>
Body<T> body_of(const ConvexPolytope& hull, const Mat3& rotation, const Vec3& translation) {
  Body<T> body;
  for (const Vec3& v : hull.vertices) {
    Triple<T> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = static_cast<T>(rotation.rows[i].x) * static_cast<T>(v.x) +
             static_cast<T>(rotation.rows[i].y) * static_cast<T>(v.y) +
             static_cast<T>(rotation.rows[i].z) * static_cast<T>(v.z) +
             static_cast<T>(translation[i]);
    }
    body.vertices.push_back(p);
  }
  for (const Triangle& t : hull.facets) {
    const auto& a = body.vertices[t[0]];
    body.normals.push_back(cross_of(minus(body.vertices[t[1]], a), minus(body.vertices[t[2]], a)));
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] < t[(i + 1) % 3]) {
        body.edges.push_back(minus(body.vertices[t[(i + 1) % 3]], body.vertices[t[i]]));
      }
    }
  }
  return body;
}

/// The largest gap over all axes, in units of the axis' length: positive iff apart. For integers
/// only the sign is meant: 1, 0 (touching) or -1 (overlapping).
template <typename T>
T separation(const Body<T>& a, const Body<T>& b) {
  std::vector<Triple<T>> axes = a.normals;
  axes.insert(axes.end(), b.normals.begin(), b.normals.end());
  for (const auto& e : a.edges) {
    for (const auto& f : b.edges) axes.push_back(cross_of(e, f));
  }
  constexpr bool kExact = std::numeric_limits<T>::is_integer;
  T best = kExact ? T{-1} : -std::numeric_limits<T>::max();
  for (const auto& axis : axes) {
    const T squared = dot_of(axis, axis);
    if (!(squared > static_cast<T>(1e-16))) continue;  // parallel edges; 0 for integers
    T low_a = dot_of(axis, a.vertices[0]);
    T high_a = low_a;
    for (const auto& v : a.vertices) {
      const T s = dot_of(axis, v);
      low_a = s < low_a ? s : low_a;
      high_a = s > high_a ? s : high_a;
    }
    T low_b = dot_of(axis, b.vertices[0]);
    T high_b = low_b;
    for (const auto& v : b.vertices) {
      const T s = dot_of(axis, v);
      low_b = s < low_b ? s : low_b;
      high_b = s > high_b ? s : high_b;
    }
    const T gap = low_b - high_a > low_a - high_b ? low_b - high_a : low_a - high_b;
    T value{};
    if constexpr (kExact) {
      value = gap > 0 ? T{1} : (gap == 0 ? T{0} : T{-1});
    } else {
      value = gap / std::sqrt(squared);
    }
    if (value > best) best = value;
  }
  return best;
}

}  // namespace carpus::oracles
