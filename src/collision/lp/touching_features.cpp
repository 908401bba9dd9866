// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// With w = b - a for the seeds (a, b):
// 1. n, the normal of the triangle w0 w1 w2, and h = n . w0 in twice the digits; h must not be
//    lost in their rounding.
// 2. n points away from the second body's other vertices or towards them, and the other way round
//    for the first's: all neighbours of the seeds' vertices must say the same. By convexity then
//    all differences lie on one side of the triangle's plane.
// 3. The origin on the other side: apart. On the same side, and in the tetrahedron of the triangle
//    (two of them for the parallelogram of two edges) and a difference off the plane: they meet.
#include "collision/lp/touching_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "collision/closest/double_double.hpp"
#include "geometry/tolerance.hpp"

namespace carpus::collision {
namespace {

/// Bounds of relative errors in twice the digits: one operation is off by at most 2^-102 of the
/// magnitudes that enter [dekker1971]; a placed vertex has six of them a component.
constexpr double kWideRoundoff = 0x1p-98;

/// Sizes within which no product of three underflows or overflows in a way that the bounds do not
/// cover [mm].
constexpr double kLeastSize = 1e-30;
constexpr double kMostSize = 1e30;

double largest_component(const Vec3& v) noexcept {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// A vertex as placed, and the sum of the magnitudes that entered its largest component.
struct PlacedVertex {
  WideVec3 at;
  double size = 0;
};

PlacedVertex place(const PlacedBody& placed, std::uint32_t vertex) noexcept {
  const Vec3& v = placed.body->vertices()[vertex];
  const Vec3& t = placed.translation;
  PlacedVertex result;
  if (placed.rotation == Mat3::identity()) {
    result.at = {DoubleDouble::sum(v.x, t.x), DoubleDouble::sum(v.y, t.y),
                 DoubleDouble::sum(v.z, t.z)};
    result.size = largest_component(v) + largest_component(t);
    return result;
  }
  const auto component = [&](std::size_t i) {
    const Vec3& r = placed.rotation.rows[i];
    result.size = std::max(result.size, std::abs(r.x * v.x) + std::abs(r.y * v.y) +
                                            std::abs(r.z * v.z) + std::abs(t[i]));
    return DoubleDouble::product(r.x, v.x) + DoubleDouble::product(r.y, v.y) +
           DoubleDouble::product(r.z, v.z) + DoubleDouble(t[i]);
  };
  result.at = {component(0), component(1), component(2)};
  return result;
}

/// Where the neighbours of a feature's vertex lie.
struct Neighbours {
  bool are_certain = false;  ///< all on one side, and every one by more than rounding
  bool are_above = false;
  std::uint32_t farthest = 0;  ///< from the plane
};

/// On which side of the plane through `vertex` with normal n its neighbours lie, but those on the
/// features, which lie on the plane exactly.
Neighbours neighbours_of(const PlacedBody& placed,
                         std::uint32_t vertex,
                         const Vec3& n,
                         std::span<const std::uint32_t> on_plane) noexcept {
  // n turned into the body's frame; `size` bounds what entered. Rounding: 4 u for a component of
  // the turned normal and 2 u for n itself, 1 u for the step, 3 u for the sum of products.
  Vec3 turned;
  Vec3 size;
  const double largest = largest_component(n);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& r = placed.rotation.rows[i];
    turned += r * n[i];
    size += Vec3{std::abs(r.x), std::abs(r.y), std::abs(r.z)} * largest;
  }
  const Vec3& from = placed.body->vertices()[vertex];
  Neighbours found;
  double most = 0;
  bool is_any_below = false;
  bool is_any_above = false;
  for (const std::uint32_t neighbour : placed.body->vertex_neighbours(vertex)) {
    if (std::find(on_plane.begin(), on_plane.end(), neighbour) != on_plane.end()) continue;
    const Vec3 step = placed.body->vertices()[neighbour] - from;
    const double bound =
        16 * kRoundoff *
            (size.x * std::abs(step.x) + size.y * std::abs(step.y) + size.z * std::abs(step.z)) +
        kUnderflowBound;
    const double height = dot(turned, step);
    if (!(std::abs(height) > bound)) return found;
    (height > 0 ? is_any_above : is_any_below) = true;
    if (std::abs(height) > most) {
      most = std::abs(height);
      found.farthest = neighbour;
    }
  }
  found.are_certain = is_any_above != is_any_below;
  found.are_above = is_any_above;
  return found;
}

/// Is the origin strictly within the three planes through the apex and the triangle's sides? With
/// `sign` that of the triangle's normal towards the apex.
bool is_below_triangle(const std::array<Vec3, 3>& w, const Vec3& apex, double sign) noexcept {
  const double size =
      std::max({largest_component(w[0]), largest_component(w[1]), largest_component(w[2])});
  // A sum of 6 products of three factors, each off by 4 u or less: under 6 * 18 u.
  const double bound =
      128 * kRoundoff * size * size * std::max(size, largest_component(apex)) + kUnderflowBound;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(sign * dot(cross(w[i], w[(i + 1) % 3]), apex) > bound)) return false;
  }
  return true;
}

/// Vertices of a body whose edges from `vertex` lie on the triangle's plane exactly: two seeds with
/// the same vertex of the other body differ by such an edge.
std::array<std::uint32_t, 3> on_plane_with(std::uint32_t vertex,
                                           const std::array<std::uint32_t, 3>& own,
                                           const std::array<std::uint32_t, 3>& other) noexcept {
  std::array<std::uint32_t, 3> found{vertex, vertex, vertex};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (own[i] == vertex && other[i] == other[k]) found[k] = own[k];
    }
  }
  return found;
}

}  // namespace

Verdict touching_features_meet(const PlacedBody& first,
                               const PlacedBody& second,
                               const ExactHint& hint) noexcept {
  if (hint.seed_count < 3) return Verdict::Unknown;
  std::array<std::uint32_t, 3> of_first{};
  std::array<std::uint32_t, 3> of_second{};
  std::array<WideVec3, 3> w;
  std::array<Vec3, 3> rounded;
  double size = 0;
  PlacedVertex a;
  PlacedVertex b;
  for (std::size_t i = 0; i < 3; ++i) {
    of_first[i] = hint.seeds[i][0];
    of_second[i] = hint.seeds[i][1];
    if (i == 0 || of_first[i] != of_first[i - 1]) a = place(first, of_first[i]);
    if (i == 0 || of_second[i] != of_second[i - 1]) b = place(second, of_second[i]);
    w[i] = b.at - a.at;
    rounded[i] = w[i].rounded();
    size = std::max(size, a.size + b.size);
  }
  const double reach = std::max({largest_component(rounded[0]), largest_component(rounded[1]),
                                 largest_component(rounded[2])});
  const WideVec3 e1 = w[1] - w[0];
  const WideVec3 e2 = w[2] - w[0];
  const double edge = std::max(largest_component(e1.rounded()), largest_component(e2.rounded()));
  if (!(size < kMostSize && edge > kLeastSize)) return Verdict::Unknown;
  const WideVec3 normal = cross(e1, e2);
  const Vec3 n = normal.rounded();
  const double h = dot(normal, w[0]).high;
  // Components of w are off by r = kWideRoundoff * size, of the edges by 3 r, of the normal by
  // 16 edge r; h by 3 (2 edge^2 r + reach * 16 edge r) and its own rounding.
  const double rounding = kWideRoundoff * size;
  if (!(std::abs(h) > 128 * edge * (edge + reach) * rounding)) return Verdict::Unknown;
  // What the normal lost must be less than rounding it to doubles.
  if (!(largest_component(n) * kRoundoff > 32 * edge * rounding)) return Verdict::Unknown;

  const Neighbours around_first =
      neighbours_of(first, of_first[1], n, on_plane_with(of_first[1], of_first, of_second));
  if (!around_first.are_certain) return Verdict::Unknown;
  const Neighbours around_second =
      neighbours_of(second, of_second[1], n, on_plane_with(of_second[1], of_second, of_first));
  if (!around_second.are_certain || around_second.are_above == around_first.are_above) {
    return Verdict::Unknown;
  }
  // All differences lie on the side of the triangle's plane to which sign * n points.
  const double sign = around_second.are_above ? 1 : -1;
  if (sign * h > 0) return Verdict::Apart;

  // The rounding of differences so far out must not matter here.
  if (!(size <= 0x1p20 * reach)) return Verdict::Unknown;
  const Vec3 apex =
      (place(second, around_second.farthest).at - place(first, of_first[1]).at).rounded();
  if (is_below_triangle(rounded, apex, sign)) return Verdict::Meet;
  const bool is_two_edges = hint.seed_count == 4 && of_first[0] == of_first[1] &&
                            of_second[0] == of_second[2] && hint.seeds[3][0] == of_first[2] &&
                            hint.seeds[3][1] == of_second[1];
  if (is_two_edges) {
    const Vec3 opposite = rounded[1] + (rounded[2] - rounded[0]);
    if (is_below_triangle({opposite, rounded[2], rounded[1]}, apex, sign)) return Verdict::Meet;
  }
  return Verdict::Unknown;
}

}  // namespace carpus::collision
