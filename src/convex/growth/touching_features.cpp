// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The differences b - a of points of the features are w0 + s e1 + t e2: a parallelogram for two
// edges, a triangle for a vertex and a face.
// 1. n = e1 x e2 in doubles, and h = n . w for the difference w nearest to the origin, or one near
//    it: any point of the plane will do, as n is square to it. There w is as small as the gap, so
//    that a rounded n will do, and only w itself has to be right (split_point.hpp).
// 2. The plane supports a body if the neighbours of its feature lie on one side: all of a vertex's,
//    a corner of each of an edge's two faces, one beside a face. By convexity then all differences
//    lie on one side of the features' plane, if the bodies do not lie on the same.
// 3. The origin on the other side: apart. On the same side, and in the pyramid over the features'
//    differences whose apex is another difference: they meet.
#include "convex/growth/touching_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "convex/growth/split_point.hpp"
#include "convex/relative_pose.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::convex {
namespace {

/// Sizes within which no product underflows or overflows in a way that the bounds do not cover.
constexpr double kLeastSizeMm = 0x1p-40;
constexpr double kMostSizeMm = 0x1p100;
constexpr double kLeastSquaredNormal = 0x1p-600;

/// More than the sum of magnitudes of a row or a column of a matrix within kMostSquaredNorm.
constexpr double kMostStretch = 3.1;

double largest_component(const Vec3& v) noexcept {
  return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// A feature of a placed body: a vertex, an edge or a face, of which three corners will do.
template <std::size_t kCorners>
struct Side {
  const PlacedBody& placed;
  const Feature& feature;
  bool is_turned = false;
  std::array<std::uint32_t, 3> vertices{};
  CornerShares<kCorners> at;

  Side(const PlacedBody& p, const Feature& f) noexcept
      : placed(p), feature(f), is_turned(p.rotation != Mat3::identity()) {
    if constexpr (kCorners == 3) {
      const std::vector<std::uint32_t>& face = p.body->faces()[f.id].corners;
      vertices = {face[0], face[1], face[2]};
    } else {
      vertices = {f.id, f.head, 0};
    }
    for (std::size_t i = 0; i < kCorners; ++i) at.corners[i] = p.body->vertices()[vertices[i]];
  }
  [[nodiscard]] Vec3 step(std::size_t i) const noexcept { return at.corners[i] - at.corners[0]; }
  [[nodiscard]] Vec3 turned(const Vec3& v) const noexcept {
    return is_turned ? placed.rotation * v : v;
  }
  [[nodiscard]] Vec3 turned_back(const Vec3& v) const noexcept {
    if (!is_turned) return v;
    const auto& r = placed.rotation.rows;
    return r[0] * v.x + r[1] * v.y + r[2] * v.z;
  }
  [[nodiscard]] SplitPoint point(double size_mm) const noexcept {
    return split_point(at, placed.rotation, is_turned, placed.translation, size_mm);
  }
  [[nodiscard]] bool is_covered() const noexcept {
    return !is_turned || squared_norm(placed.rotation) <= kMostSquaredNorm;
  }
  [[nodiscard]] double size_mm() const noexcept {
    return std::max(placed.body->largest_coordinate_mm(),
                    largest_component(placed.translation) * 0.125);
  }
  /// At least the sum of components of any step within the body.
  [[nodiscard]] double reach_mm() const noexcept { return 4 * placed.body->radius_mm(); }
};

/// The differences of the features' points, in doubles.
struct Differences {
  Vec3 w0;
  Vec3 n;              ///< square to both edges
  double squared = 0;  ///< of n
  double largest = 0;  ///< component of n
  double n_error = 0;  ///< of a component
  double edge_mm = 0;  ///< more than a component of an edge
  double s = 0;        ///< where the origin lies, as seen along n
  double t = 0;

  template <std::size_t kFirst, std::size_t kSecond>
  Differences(const Side<kFirst>& a, const Side<kSecond>& b) noexcept
      : w0(b.turned(b.at.corners[0]) - a.turned(a.at.corners[0]) +
           (b.placed.translation - a.placed.translation)) {
    if constexpr (kFirst == 1) {
      set(b.step(1), b.step(2), b.turned(b.step(1)), b.turned(b.step(2)));
    } else if constexpr (kFirst == 2) {
      set(a.step(1), b.step(1), -a.turned(a.step(1)), b.turned(b.step(1)));
    } else {
      set(a.step(1), a.step(2), -a.turned(a.step(1)), -a.turned(a.step(2)));
    }
  }

  /// The exact normal is within half of n's length, as the bounds of s and t take for granted.
  [[nodiscard]] bool is_certain() const noexcept {
    return squared > kLeastSquaredNormal && 8 * n_error < largest;
  }
  /// A bound of what s and t are off by, with w0 off by 128 u size.
  [[nodiscard]] double share_error(double size_mm) const noexcept {
    const double sum = taxicab(n);
    const double away = largest_component(w0);
    const double of_cross = edge_mm * kRoundoff * (3 * 128 * size_mm + 16 * away);
    const double of_product = of_cross * (sum + 3 * n_error) +
                              6 * away * edge_mm * (n_error + kRoundoff * sum) +
                              n_error * (2 * sum + 3 * n_error);
    return 2 * of_product / squared + 8 * kRoundoff;
  }

 private:
  void set(const Vec3& step1, const Vec3& step2, const Vec3& e1, const Vec3& e2) noexcept {
    // Edges are off by 4 u of these bounds, 1 for the step and 3 for the turn; n by 20 u of both.
    const double edge1 = 2 * taxicab(step1);
    const double edge2 = 2 * taxicab(step2);
    edge_mm = std::max(edge1, edge2);
    n = cross(e1, e2);
    n_error = 32 * kRoundoff * edge1 * edge2;
    largest = largest_component(n);
    squared = squared_length(n);
    const double share = -1 / squared;
    s = dot(cross(w0, e2), n) * share;
    t = dot(cross(e1, w0), n) * share;
  }
};

/// How a body lies to the plane through its feature.
struct Heights {
  int side = 0;        ///< all of the body is on this side, by n; 0: not certain
  double highest = 0;  ///< of a point of the body over the plane, times |n|; rounded down
};

/// A corner of the face that is not on its edge.
std::uint32_t corner_beside(const ConvexBody& body,
                            std::uint32_t face,
                            std::uint32_t tail,
                            std::uint32_t head) noexcept {
  const std::vector<std::uint32_t>& corners = body.faces()[face].corners;
  if (corners.size() == 3) return corners[0] ^ corners[1] ^ corners[2] ^ tail ^ head;
  return *std::find_if(corners.begin(), corners.end(),
                       [&](std::uint32_t c) { return c != tail && c != head; });
}

template <std::size_t kCorners>
Heights heights_of(const Side<kCorners>& side, const Differences& plane) noexcept {
  const ConvexBody& body = *side.placed.body;
  const Vec3 turned = side.turned_back(plane.n);
  double lowest = HUGE_VAL;
  double highest = -HUGE_VAL;
  const auto add = [&](std::uint32_t vertex) {
    const double height = dot(turned, body.vertices()[vertex] - side.at.corners[0]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  };
  const auto add_beside = [&](std::uint32_t face) {
    add(corner_beside(body, face, side.vertices[0], side.vertices[1]));
  };
  if constexpr (kCorners == 1) {
    for (const std::uint32_t v : body.vertex_neighbours(side.feature.id)) add(v);
  } else if constexpr (kCorners == 2) {
    add_beside(side.feature.left);
    add_beside(side.feature.right);
  } else {
    add_beside(body.faces()[side.feature.id].neighbours[0]);
  }
  // A component of `turned` is off by that of n and 3 u; then 4 u for the step and its product.
  const double bound =
      kMostStretch * (1.1 * plane.n_error + 8 * kRoundoff * plane.largest) * side.reach_mm() +
      kUnderflowBound;
  if (lowest > bound) return {1, (highest - bound) * (1 - 8 * kRoundoff)};
  if (highest < -bound) return {-1, (-lowest - bound) * (1 - 8 * kRoundoff)};
  return {};
}

/// h = n . w, and what it may be off by.
struct Height {
  double h = 0;
  double error = 0;
};

template <std::size_t kFirst, std::size_t kSecond>
Height height_of(Side<kFirst>& a,
                 Side<kSecond>& b,
                 const Differences& plane,
                 double size_mm) noexcept {
  const NearestMultiple grid(kShareUnit);
  const double s = grid(std::clamp(plane.s, 0.0, 1.0));
  const double t = grid(std::clamp(plane.t, 0.0, kFirst == 2 ? 1.0 : 1 - s));
  if constexpr (kFirst == 1) {
    b.at.shares = {0, s, t};
  } else if constexpr (kFirst == 2) {
    a.at.shares[1] = s;
    b.at.shares[1] = t;
  } else {
    a.at.shares = {0, s, t};
  }
  const Vec3 w = b.point(size_mm).minus(a.point(size_mm));
  const double w_error = SplitPoint::kError * size_mm + kRoundoff * largest_component(w);
  return {dot(plane.n, w), 2 * ((plane.n_error + 4 * kRoundoff * plane.largest) * taxicab(w) +
                                3 * (plane.largest + plane.n_error) * w_error) +
                               kUnderflowBound};
}

template <std::size_t kFirst>
Verdict decide(const PlacedBody& first,
               const PlacedBody& second,
               const FeaturePair& pair) noexcept {
  Side<kFirst> a(first, pair.first);
  Side<4 - kFirst> b(second, pair.second);
  const double size = power_of_two_above(std::max(a.size_mm(), b.size_mm()));
  if (!(size > kLeastSizeMm && size < kMostSizeMm && a.is_covered() && b.is_covered())) {
    return Verdict::Unknown;
  }
  const Differences plane(a, b);
  if (!plane.is_certain()) return Verdict::Unknown;
  const Height of_origin = height_of(a, b, plane, size);
  const double h = of_origin.h;
  if (!(std::abs(h) > of_origin.error)) return Verdict::Unknown;

  const Heights below = heights_of(a, plane);
  if (below.side == 0) return Verdict::Unknown;
  const Heights above = heights_of(b, plane);
  if (above.side != -below.side) return Verdict::Unknown;
  if ((h > 0) == (above.side > 0)) return Verdict::Apart;

  // The origin lies by the share `deep` of the way to the apex below the features' differences.
  // Seen from the apex it moves on their plane by at most deep (1 + 2 aside), where `aside` bounds
  // how far, in s and t, the apex is from w0.
  const double deep = (std::abs(h) + of_origin.error) / std::max(above.highest, below.highest);
  const double aside =
      4 * std::max(a.reach_mm(), b.reach_mm()) * plane.edge_mm * taxicab(plane.n) / plane.squared;
  const double inside = std::min(
      {plane.s, plane.t, kFirst == 2 ? std::min(1 - plane.s, 1 - plane.t) : 1 - plane.s - plane.t});
  const double needed = 2 * deep * (1 + 2 * aside) + 2 * plane.share_error(size);
  return inside > needed ? Verdict::Meet : Verdict::Unknown;
}

}  // namespace

Verdict touching_features_meet(const PlacedBody& first,
                               const PlacedBody& second,
                               const FeaturePair& pair) noexcept {
  const FeatureKind a = pair.first.kind;
  const FeatureKind b = pair.second.kind;
  if (a == FeatureKind::Edge && b == FeatureKind::Edge) return decide<2>(first, second, pair);
  if (a == FeatureKind::Vertex && b == FeatureKind::Face) return decide<1>(first, second, pair);
  if (a == FeatureKind::Face && b == FeatureKind::Vertex) return decide<3>(first, second, pair);
  return Verdict::Unknown;
}

}  // namespace carpus::convex
