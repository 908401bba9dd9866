// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// With w = b - a for the seeds (a, b), and e1 = w1 - w0, e2 = w2 - w0:
// 1. n = e1 x e2 in doubles, and h = n . w in twice the digits' worth: w may be any point
//    w0 + s e1 + t e2 of the triangle's plane, as n is square to it. At the one nearest to the
//    origin w is as small as the gap, so that a rounded n will do, and only w itself has to be
//    right.
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
/// magnitudes that enter [dekker1971]; a component of a placed point has under 16 of them.
constexpr double kWideRoundoff = 0x1p-98;

/// Sizes within which no product of three underflows or overflows in a way that the bounds do not
/// cover [mm].
constexpr double kLeastSize = 1e-30;
constexpr double kMostSize = 1e30;

double largest_component(const Vec3& v) noexcept {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The seeds' vertices of one body: the first, and the steps to the second and the third, which are
/// zero where these are the same.
struct Corners {
  const PlacedBody& placed;
  std::array<std::uint32_t, 3> vertices;

  [[nodiscard]] const Vec3& at(std::size_t i) const noexcept {
    return placed.body->vertices()[vertices[i]];
  }
  [[nodiscard]] Vec3 step(std::size_t i) const noexcept { return at(i) - at(0); }
  [[nodiscard]] Vec3 turned_step(std::size_t i) const noexcept { return placed.rotation * step(i); }

  /// The largest component of R v, had all products one sign.
  [[nodiscard]] double magnitude(const Vec3& v) const noexcept {
    double most = 0;
    for (const Vec3& r : placed.rotation.rows) {
      most = std::max(most, std::abs(r.x * v.x) + std::abs(r.y * v.y) + std::abs(r.z * v.z));
    }
    return most;
  }

  /// The placed point at(0) + s step(1) + t step(2).
  [[nodiscard]] WideVec3 point(double s, double t) const noexcept {
    WideVec3 p(at(0));
    if (vertices[1] != vertices[0]) p = p + wide_step(1) * DoubleDouble(s);
    if (vertices[2] != vertices[0]) p = p + wide_step(2) * DoubleDouble(t);
    const Vec3& shift = placed.translation;
    if (placed.rotation == Mat3::identity()) return p + WideVec3(shift);
    const auto component = [&](std::size_t i) {
      const Vec3& r = placed.rotation.rows[i];
      return p.x * DoubleDouble(r.x) + p.y * DoubleDouble(r.y) + p.z * DoubleDouble(r.z) +
             DoubleDouble(shift[i]);
    };
    return {component(0), component(1), component(2)};
  }

 private:
  [[nodiscard]] WideVec3 wide_step(std::size_t i) const noexcept {
    const Vec3& from = at(0);
    const Vec3& to = at(i);
    return {DoubleDouble::sum(to.x, -from.x), DoubleDouble::sum(to.y, -from.y),
            DoubleDouble::sum(to.z, -from.z)};
  }
};

/// Where the neighbours of a feature's vertex lie.
struct Neighbours {
  bool are_certain = false;  ///< all on one side, and every one by more than rounding
  bool are_above = false;
  std::uint32_t farthest = 0;  ///< from the plane
};

/// On which side of the plane through `vertex` with normal n, whose components are off by `n_error`
/// at most, its neighbours lie, but those on the features, which lie on the plane exactly.
Neighbours neighbours_of(const PlacedBody& placed,
                         std::uint32_t vertex,
                         const Vec3& n,
                         double n_error,
                         std::span<const std::uint32_t> on_plane) noexcept {
  // n turned into the body's frame; `error` bounds what a component is off by. Rounding: 4 u for a
  // component of the turned normal, 1 u for the step, 3 u for the sum of products, and n's own.
  Vec3 turned;
  Vec3 error;
  const double off = 16 * kRoundoff * largest_component(n) + n_error;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& r = placed.rotation.rows[i];
    turned += r * n[i];
    error += Vec3{std::abs(r.x), std::abs(r.y), std::abs(r.z)} * off;
  }
  const Vec3& from = placed.body->vertices()[vertex];
  Neighbours found;
  double most = 0;
  bool is_any_below = false;
  bool is_any_above = false;
  for (const std::uint32_t neighbour : placed.body->vertex_neighbours(vertex)) {
    if (std::find(on_plane.begin(), on_plane.end(), neighbour) != on_plane.end()) continue;
    const Vec3 step = placed.body->vertices()[neighbour] - from;
    const double bound = error.x * std::abs(step.x) + error.y * std::abs(step.y) +
                         error.z * std::abs(step.z) + kUnderflowBound;
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
/// `sign` that of the triangle's normal towards the apex, and components off by `error` at most.
bool is_below_triangle(const std::array<Vec3, 3>& w,
                       const Vec3& apex,
                       double error,
                       double sign) noexcept {
  const double size = std::max({largest_component(w[0]), largest_component(w[1]),
                                largest_component(w[2]), largest_component(apex)});
  // A sum of 6 products of three factors, each off by `error`, and 6 roundings: under 6 (3 error
  // size^2 + 6 u size^3), and once more for second orders.
  const double bound = (36 * error + 72 * kRoundoff * size) * size * size + kUnderflowBound;
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
  Corners a{first, {}};
  Corners b{second, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    a.vertices[i] = hint.seeds[i][0];
    b.vertices[i] = hint.seeds[i][1];
  }
  const Vec3 w0 = second.rotation * b.at(0) - first.rotation * a.at(0) +
                  (second.translation - first.translation);
  const Vec3 e1 = b.turned_step(1) - a.turned_step(1);
  const Vec3 e2 = b.turned_step(2) - a.turned_step(2);
  const double edge = std::max(b.magnitude(b.step(1)) + a.magnitude(a.step(1)),
                               b.magnitude(b.step(2)) + a.magnitude(a.step(2)));
  const double size = b.magnitude(b.at(0)) + a.magnitude(a.at(0)) +
                      largest_component(second.translation) + largest_component(first.translation) +
                      8 * edge;
  if (!(size < kMostSize && edge > kLeastSize)) return Verdict::Unknown;
  // Components of the edges are off by 6 u edge: steps 1, turned 3, difference 1. Of the normal by
  // 2 (2 * 6 + 1) u edge^2 and 2 u edge^2.
  const Vec3 n = cross(e1, e2);
  const double n_error = 32 * kRoundoff * edge * edge;

  // The triangle's point nearest to the origin, or one not too far away.
  const double squared = squared_length(n);
  const auto share = [squared](double s) { return std::clamp(s / squared, -2.0, 2.0); };
  const double s = share(-dot(cross(w0, e2), n));
  const double t = share(-dot(cross(e1, w0), n));
  const Vec3 w = (b.point(s, t) - a.point(s, t)).rounded();
  // n . w: n is off by n_error, w by its rounding and by that of twice the digits.
  const double h = dot(n, w);
  const double largest = largest_component(w);
  const double w_error = 4 * kRoundoff * largest + kWideRoundoff * size;
  const double h_error =
      3 * (n_error * largest + (largest_component(n) + n_error) * w_error) + kUnderflowBound;
  if (!(std::abs(h) > 2 * h_error)) return Verdict::Unknown;

  const Neighbours around_first = neighbours_of(
      first, a.vertices[1], n, n_error, on_plane_with(a.vertices[1], a.vertices, b.vertices));
  if (!around_first.are_certain) return Verdict::Unknown;
  const Neighbours around_second = neighbours_of(
      second, b.vertices[1], n, n_error, on_plane_with(b.vertices[1], b.vertices, a.vertices));
  if (!around_second.are_certain || around_second.are_above == around_first.are_above) {
    return Verdict::Unknown;
  }
  // All differences lie on the side of the triangle's plane to which sign * n points.
  const double sign = around_second.are_above ? 1 : -1;
  if (sign * h > 0) return Verdict::Apart;

  // From here doubles: components are off by 16 u size, and by 8 u of the step to the apex.
  const std::array<Vec3, 3> corners{w0, w0 + e1, w0 + e2};
  const Vec3 to_apex =
      second.body->vertices()[around_second.farthest] - second.body->vertices()[b.vertices[1]];
  const Vec3 apex = corners[1] + second.rotation * to_apex;
  const double error = 16 * kRoundoff * (size + b.magnitude(to_apex));
  if (is_below_triangle(corners, apex, error, sign)) return Verdict::Meet;
  const bool is_two_edges = hint.seed_count == 4 && a.vertices[0] == a.vertices[1] &&
                            b.vertices[0] == b.vertices[2] && hint.seeds[3][0] == a.vertices[2] &&
                            hint.seeds[3][1] == b.vertices[1];
  if (is_two_edges) {
    const Vec3 opposite = corners[1] + e2;
    if (is_below_triangle({opposite, corners[2], corners[1]}, apex, 2 * error, sign)) {
      return Verdict::Meet;
    }
  }
  return Verdict::Unknown;
}

}  // namespace carpus::collision
