// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Oracles for the tests of this folder, in long double, by trying everything: distance over all
// pairs of corners, edges and facets; depth over all normals that a facet of the Minkowski
// difference can have. They share nothing with what they judge but the list of facets.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"

namespace carpus::test {

using Real = long double;
struct RealVec3 {
  Real x = 0;
  Real y = 0;
  Real z = 0;
};
inline RealVec3 operator+(const RealVec3& a, const RealVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline RealVec3 operator-(const RealVec3& a, const RealVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline RealVec3 operator*(const RealVec3& a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
inline Real dot(const RealVec3& a, const RealVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline RealVec3 cross(const RealVec3& a, const RealVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(const RealVec3& a) { return std::sqrt(dot(a, a)); }
inline RealVec3 real(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A body in the first body's frame, about the first one's centre.
struct PlacedBody {
  std::vector<RealVec3> corners;
  std::vector<Triangle> facets;
  std::vector<std::array<std::uint32_t, 2>> edges;
};

inline PlacedBody placed(const convex::ConvexBody& body,
                         const convex::PairPose& pose,
                         const Vec3& origin) {
  PlacedBody result;
  for (const Vec3& v : body.vertices()) {
    const Mat3& m = pose.rotation;
    const RealVec3 p = real(v);
    result.corners.push_back(
        RealVec3{dot(real(m.rows[0]), p), dot(real(m.rows[1]), p), dot(real(m.rows[2]), p)} +
        (real(pose.translation) - real(origin)));
  }
  result.facets = body.polytope().facets;
  for (const Triangle& t : result.facets) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] < t[(i + 1) % 3]) result.edges.push_back({t[i], t[(i + 1) % 3]});
    }
  }
  return result;
}

inline Real corner_to_edge(const RealVec3& p, const RealVec3& a, const RealVec3& b) {
  const RealVec3 e = b - a;
  const Real t = std::clamp<Real>(dot(p - a, e) / dot(e, e), 0, 1);
  return length(a + e * t - p);
}

/// Where both lines' nearest points lie within the edges, and infinity else.
inline Real between_edges(const RealVec3& a,
                          const RealVec3& b,
                          const RealVec3& c,
                          const RealVec3& d) {
  const RealVec3 e = b - a;
  const RealVec3 f = d - c;
  const RealVec3 n = cross(e, f);
  const Real squared = dot(n, n);
  if (!(squared > 0)) return std::numeric_limits<Real>::infinity();
  const Real s = dot(cross(c - a, f), n) / squared;
  const Real t = dot(cross(c - a, e), n) / squared;
  if (s < 0 || s > 1 || t < 0 || t > 1) return std::numeric_limits<Real>::infinity();
  return length(c + f * t - (a + e * s));
}

inline Real corner_to_facet(const RealVec3& p,
                            const RealVec3& a,
                            const RealVec3& b,
                            const RealVec3& c) {
  const RealVec3 n = cross(b - a, c - a);
  const Real squared = dot(n, n);
  const bool is_above = dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
                        dot(cross(a - c, p - c), n) >= 0;
  if (!is_above || !(squared > 0)) return std::numeric_limits<Real>::infinity();
  return std::abs(dot(p - a, n)) / std::sqrt(squared);
}

/// Of the boundaries: right where the bodies are apart.
inline Real exhaustive_distance(const PlacedBody& a, const PlacedBody& b) {
  Real best = std::numeric_limits<Real>::infinity();
  const auto corners_of_one = [&](const PlacedBody& one, const PlacedBody& other) {
    for (const RealVec3& p : one.corners) {
      for (const Triangle& t : other.facets) {
        best = std::min(best, corner_to_facet(p, other.corners[t[0]], other.corners[t[1]],
                                              other.corners[t[2]]));
      }
      for (const auto& [i, j] : other.edges) {
        best = std::min(best, corner_to_edge(p, other.corners[i], other.corners[j]));
      }
    }
  };
  corners_of_one(a, b);
  corners_of_one(b, a);
  for (const auto& [i, j] : a.edges) {
    for (const auto& [k, l] : b.edges) {
      best = std::min(best, between_edges(a.corners[i], a.corners[j], b.corners[k], b.corners[l]));
    }
  }
  return best;
}

/// Width of the difference { b - a } beyond the origin along the unit vector n.
inline Real height_along(const PlacedBody& a, const PlacedBody& b, const RealVec3& n) {
  Real low = std::numeric_limits<Real>::infinity();
  Real high = -low;
  for (const RealVec3& p : a.corners) low = std::min(low, dot(p, n));
  for (const RealVec3& p : b.corners) high = std::max(high, dot(p, n));
  return high - low;
}

/// Least height over all normals of facets of the difference: the depth if it is not negative (any
/// other direction is higher). Negative iff the bodies are apart.
inline Real exhaustive_depth(const PlacedBody& a, const PlacedBody& b) {
  Real best = std::numeric_limits<Real>::infinity();
  const auto try_normal = [&](const RealVec3& n, Real least) {
    const Real size = length(n);
    if (!(size > least)) return;
    best = std::min(best, height_along(a, b, n * (1 / size)));
    best = std::min(best, height_along(a, b, n * (-1 / size)));
  };
  for (const PlacedBody* body : {&a, &b}) {
    for (const Triangle& t : body->facets) {
      const RealVec3& p = body->corners[t[0]];
      try_normal(cross(body->corners[t[1]] - p, body->corners[t[2]] - p), 0);
    }
  }
  for (const auto& [i, j] : a.edges) {
    const RealVec3 e = a.corners[j] - a.corners[i];
    for (const auto& [k, l] : b.edges) {
      const RealVec3 f = b.corners[l] - b.corners[k];
      // Parallel edges span nothing; what rounding makes of them is a normal like any other, and
      // none is lower than the depth.
      try_normal(cross(e, f), 0);
    }
  }
  return best;
}

}  // namespace carpus::test
