// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Ordinary pairs: each triangle must reach the other's plane, then some edge that is not in the
// other's plane must pass through it. The rest: coplanar triangles in the plane, after dropping the
// coordinate that keeps the triangle a triangle; triangles without area edge by edge.
#include "survey/volumes/triangle_contact.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/predicates.hpp"

namespace carpus::survey {
namespace {

using Signs = std::array<int, 3>;

bool all_on_one_side(const Signs& s) noexcept {
  return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}
bool all_in_plane(const Signs& s) noexcept { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

Signs sides_of(const TrianglePoints& plane, const TrianglePoints& points) noexcept {
  return {orient3d(plane[0], plane[1], plane[2], points[0]),
          orient3d(plane[0], plane[1], plane[2], points[1]),
          orient3d(plane[0], plane[1], plane[2], points[2])};
}

/// p and q not both in the plane of t, and not strictly on one side of it.
bool crossing_edge_meets(const Vec3& p, const Vec3& q, const TrianglePoints& t) noexcept {
  const int s0 = orient3d(p, q, t[0], t[1]);
  const int s1 = orient3d(p, q, t[1], t[2]);
  if (s0 * s1 < 0) return false;
  const int s2 = orient3d(p, q, t[2], t[0]);
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}

bool some_edge_meets(const TrianglePoints& edges,
                     const Signs& sides,
                     const TrianglePoints& t) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (sides[i] * sides[j] > 0 || (sides[i] == 0 && sides[j] == 0)) continue;
    if (crossing_edge_meets(edges[i], edges[j], t)) return true;
  }
  return false;
}

// In the plane: what is left after a coordinate is dropped.

Vec2 without(const Vec3& v, std::size_t axis) noexcept {
  return axis == 0 ? Vec2{v.y, v.z} : (axis == 1 ? Vec2{v.z, v.x} : Vec2{v.x, v.y});
}

bool is_between(const Vec2& p, const Vec2& q, const Vec2& r) noexcept {
  return r.x >= std::min(p.x, q.x) && r.x <= std::max(p.x, q.x) && r.y >= std::min(p.y, q.y) &&
         r.y <= std::max(p.y, q.y);
}

bool segments_meet_in_plane(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& s) noexcept {
  const int pqr = orient2d(p, q, r);
  const int pqs = orient2d(p, q, s);
  const int rsp = orient2d(r, s, p);
  const int rsq = orient2d(r, s, q);
  if (pqr * pqs < 0 && rsp * rsq < 0) return true;
  return (pqr == 0 && is_between(p, q, r)) || (pqs == 0 && is_between(p, q, s)) ||
         (rsp == 0 && is_between(r, s, p)) || (rsq == 0 && is_between(r, s, q));
}

/// The coordinate without which three points are still not on one line; 3 if they are on one.
std::size_t dropped_axis(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (orient2d(without(a, axis), without(b, axis), without(c, axis)) != 0) return axis;
  }
  return 3;
}

/// p and q in the plane of t, which has area.
bool segment_in_plane_meets(const Vec3& p, const Vec3& q, const TrianglePoints& t) noexcept {
  const std::size_t axis = dropped_axis(t[0], t[1], t[2]);
  const Vec2 p2 = without(p, axis);
  const Vec2 q2 = without(q, axis);
  const std::array<Vec2, 3> t2{without(t[0], axis), without(t[1], axis), without(t[2], axis)};
  for (std::size_t i = 0; i < 3; ++i) {
    if (segments_meet_in_plane(p2, q2, t2[i], t2[(i + 1) % 3])) return true;
  }
  const int turn = orient2d(t2[0], t2[1], t2[2]);  // the rest: wholly inside
  return orient2d(t2[0], t2[1], p2) == turn && orient2d(t2[1], t2[2], p2) == turn &&
         orient2d(t2[2], t2[0], p2) == turn;
}

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const TrianglePoints& t) noexcept {
  const int p_side = orient3d(t[0], t[1], t[2], p);
  const int q_side = orient3d(t[0], t[1], t[2], q);
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) return segment_in_plane_meets(p, q, t);
  return crossing_edge_meets(p, q, t);
}

bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) noexcept {
  if (orient3d(p, q, r, s) != 0) return false;
  std::size_t axis = dropped_axis(p, q, r);
  if (axis == 3) axis = dropped_axis(p, q, s);
  if (axis == 3) axis = dropped_axis(r, s, p);
  if (axis == 3) axis = dropped_axis(r, s, q);
  if (axis < 3) {
    return segments_meet_in_plane(without(p, axis), without(q, axis), without(r, axis),
                                  without(s, axis));
  }
  for (std::size_t i = 0; i < 3; ++i) {  // all on one line
    if (std::max(p[i], q[i]) < std::min(r[i], s[i]) ||
        std::max(r[i], s[i]) < std::min(p[i], q[i])) {
      return false;
    }
  }
  return true;
}

bool has_area(const TrianglePoints& t) noexcept { return dropped_axis(t[0], t[1], t[2]) < 3; }

bool segment_meets_any(const Vec3& p, const Vec3& q, const TrianglePoints& t, bool t_has_area) {
  if (t_has_area) return segment_meets_triangle(p, q, t);
  return segments_meet(p, q, t[0], t[1]) || segments_meet(p, q, t[1], t[2]) ||
         segments_meet(p, q, t[2], t[0]);
}

/// Coplanar, or one without area.
bool special_triangles_meet(const TrianglePoints& a, const TrianglePoints& b) noexcept {
  const bool a_has_area = has_area(a);
  const bool b_has_area = has_area(b);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (segment_meets_any(a[i], a[j], b, b_has_area)) return true;
    if (segment_meets_any(b[i], b[j], a, a_has_area)) return true;
  }
  return false;
}

}  // namespace

bool triangles_meet(const TrianglePoints& a, const TrianglePoints& b) noexcept {
  const Signs b_sides = sides_of(a, b);
  if (all_on_one_side(b_sides)) return false;
  const Signs a_sides = sides_of(b, a);
  if (all_on_one_side(a_sides)) return false;
  if (all_in_plane(b_sides) || all_in_plane(a_sides)) return special_triangles_meet(a, b);
  return some_edge_meets(b, b_sides, a) || some_edge_meets(a, a_sides, b);
}

}  // namespace carpus::survey
