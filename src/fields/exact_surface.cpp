// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/exact_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "core/error.hpp"

namespace carpus::fields {
namespace {

/// Squared distance of two segments; parameters are clamped one after the other.
double squared_segment_distance(const Vec3& p1,
                                const Vec3& q1,
                                const Vec3& p2,
                                const Vec3& q2) noexcept {
  const Vec3 d1 = q1 - p1;
  const Vec3 d2 = q2 - p2;
  const Vec3 r = p1 - p2;
  const double a = squared_length(d1);
  const double e = squared_length(d2);
  const double f = dot(d2, r);
  const double c = dot(d1, r);
  const double b = dot(d1, d2);
  const double denominator = a * e - b * b;
  double s = denominator > 0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double t = e > 0 ? (b * s + f) / e : 0.0;
  if (!(t >= 0 && t <= 1)) {
    t = t > 1 ? 1.0 : 0.0;
    s = a > 0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
  }
  return squared_length(p1 + d1 * s - p2 - d2 * t);
}

bool passes_through(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t) noexcept {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double at_a = dot(normal, a - t[0]);
  const double at_b = dot(normal, b - t[0]);
  if (!(at_a * at_b <= 0) || at_a == at_b) return false;
  const Vec3 p = a + (b - a) * (at_a / (at_a - at_b));
  for (std::size_t i = 0; i < 3; ++i) {
    if (dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) < 0) return false;
  }
  return true;
}

/// A sample along the axis.
struct AxisSample {
  double z = 0;
  double signed_distance = 0;
  double gap = 0;
};

struct AxisPiece {
  AxisSample from;
  AxisSample to;
  double steepest = 1;
  double lowest = 0;  ///< nothing in the piece is lower
  bool operator>(const AxisPiece& other) const { return lowest > other.lowest; }
};

AxisPiece piece_between(const AxisSample& from, const AxisSample& to, double steepest) {
  return {from, to, steepest, 0.5 * (from.gap + to.gap - steepest * (to.z - from.z))};
}

}  // namespace

double segment_triangle_distance(const Vec3& a,
                                 const Vec3& b,
                                 const std::array<Vec3, 3>& t) noexcept {
  if (passes_through(a, b, t)) return 0;
  double best = std::min(squared_length(a - nearest_point_on_triangle(a, t[0], t[1], t[2])),
                         squared_length(b - nearest_point_on_triangle(b, t[0], t[1], t[2])));
  for (std::size_t i = 0; i < 3; ++i) {
    best = std::min(best, squared_segment_distance(a, b, t[i], t[(i + 1) % 3]));
  }
  return std::sqrt(best);
}

ExactSurface::ExactSurface(const TriangleMesh& surface) : surface_(surface), tree_(surface) {
  if (check_surface(surface) != SurfaceStatus::Ok) {
    throw InvalidInput("exact surface: it is not closed and consistently oriented");
  }
}

bool ExactSurface::is_inside(const Vec3& point) const {
  double solid_angle = 0;
  for (const Triangle& t : surface_.facets) {
    const Vec3 a = surface_.vertices[t[0]] - point;
    const Vec3 b = surface_.vertices[t[1]] - point;
    const Vec3 c = surface_.vertices[t[2]] - point;
    const double la = length(a);
    const double lb = length(b);
    const double lc = length(c);
    solid_angle += 2 * std::atan2(dot(a, cross(b, c)),
                                  la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return solid_angle > 6.28;  // 4 pi inside, 0 outside
}

double ExactSurface::signed_distance(const Vec3& point) const {
  const auto nearest = tree_.nearest(point);
  const double distance =
      nearest ? std::sqrt(nearest->squared_distance) : std::numeric_limits<double>::infinity();
  return is_inside(point) ? -distance : distance;
}

ExactSurface::Gap ExactSurface::gap_of(const InstrumentShape& shape,
                                       const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                                       double tolerance_mm) const {
  // The sign cannot change nearer to a sample than its distance.
  const auto sample = [&](double z, const AxisSample* left, const AxisSample* right) {
    const Vec3 p = (bone_from_tool * Point<frame::Tool>{{0, 0, z}}).v;
    AxisSample result{z, std::sqrt(tree_.nearest(p).value_or(NearestPoint{}).squared_distance), 0};
    const auto settles = [&](const AxisSample* s) {
      return s != nullptr && std::abs(z - s->z) < std::abs(s->signed_distance);
    };
    const bool inside = settles(left)    ? left->signed_distance < 0
                        : settles(right) ? right->signed_distance < 0
                                         : is_inside(p);
    if (inside) result.signed_distance = -result.signed_distance;
    result.gap = result.signed_distance - shape.radius_at(z);
    return result;
  };

  AxisSample best = sample(shape.front_z_mm(), nullptr, nullptr);
  std::priority_queue<AxisPiece, std::vector<AxisPiece>, std::greater<>> open;
  AxisSample last = best;
  for (std::size_t i = 1; i < shape.knots().size(); ++i) {
    const AxisKnot& a = shape.knots()[i - 1];
    const AxisKnot& b = shape.knots()[i];
    const AxisSample next = sample(b.z_mm, &last, nullptr);
    if (next.gap < best.gap) best = next;
    const double slope =
        b.z_mm > a.z_mm ? std::abs(b.radius_mm - a.radius_mm) / (b.z_mm - a.z_mm) : 0.0;
    open.push(piece_between(last, next, 1 + slope));
    last = next;
  }
  while (!open.empty() && open.top().lowest < best.gap - tolerance_mm) {
    const AxisPiece piece = open.top();
    open.pop();
    const AxisSample middle = sample(0.5 * (piece.from.z + piece.to.z), &piece.from, &piece.to);
    if (middle.gap < best.gap) best = middle;
    open.push(piece_between(piece.from, middle, piece.steepest));
    open.push(piece_between(middle, piece.to, piece.steepest));
  }
  return {best.gap, best.z};
}

double ExactSurface::distance_to_segment(const Vec3& a, const Vec3& b) const noexcept {
  double best = std::numeric_limits<double>::infinity();
  for (const Triangle& t : surface_.facets) {
    best = std::min(
        best,
        segment_triangle_distance(
            a, b, {surface_.vertices[t[0]], surface_.vertices[t[1]], surface_.vertices[t[2]]}));
  }
  return best;
}

}  // namespace carpus::fields
