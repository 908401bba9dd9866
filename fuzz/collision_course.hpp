// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bytes to small convex bodies, most of them degenerate in some way, and to poses of the second in
// the first one's frame at which their features all but touch, or that are no poses at all.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bytes.hpp"
#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::fuzz {

/// Lattice points, some of them one unit in the last place away, slivers, far from the origin, of
/// unequal sizes, of any bits.
inline double coordinate(Bytes& bytes, unsigned kind, std::size_t axis) {
  if (kind == 7) return bytes.any_double();
  const std::uint8_t b = bytes.byte();
  const double lattice = b % 5;
  switch (kind) {
    case 2:
      return b % 7 == 6 ? std::nextafter(lattice, b & 0x80U ? 9 : -9) : lattice;
    case 3:
      return axis == 2 ? lattice * 1e-15 : lattice;
    case 4:
      return axis == 2 ? lattice * 1e-3 : lattice;
    case 5:
      return 1e6 + 0.4 * lattice;
    case 6:
      return std::ldexp(static_cast<double>(b) - 128, b % 31 == 0 ? 40 : -3);
    default:
      return lattice;
  }
}

/// Empty where the bytes make no body.
inline std::optional<convex::ConvexBody> body_from(Bytes& bytes) {
  const std::uint8_t first = bytes.byte();
  const unsigned kind = first % 8U;
  const std::size_t count = 4 + bytes.below(9);
  // Most bodies are of the size of their coordinates.
  constexpr std::array<int, 8> kExponents{0, 0, 0, 0, -3, 17, -180, 250};
  const int exponent = kExponents[first / 32U];
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p[axis] = std::ldexp(coordinate(bytes, kind, axis), exponent);
    }
    points.push_back(p);
  }
  hull::HullResult result = hull::build_fast_hull(points);
  if (result.status != hull::HullStatus::Ok) return std::nullopt;
  return convex::ConvexBody(std::move(result.polytope));
}

/// A corner, a point of an edge or one of a face.
inline Vec3 feature_of(Bytes& bytes, const convex::ConvexBody& body) {
  const hull::PolygonalFace& face = body.faces()[bytes.below(body.faces().size())];
  const Vec3& a = body.vertices()[face.corners[0]];
  const Vec3& b = body.vertices()[face.corners[1]];
  const Vec3& c = body.vertices()[face.corners[2]];
  switch (bytes.below(3)) {
    case 0:
      return a;
    case 1:
      return a + (b - a) * 0.5;
    default:
      return a + (b - a) * 0.25 + (c - a) * 0.25;
  }
}

inline double small_integer(Bytes& bytes) { return static_cast<double>(bytes.byte()) - 127; }

/// One of the 24 rotations that permute the axes, or a reflection of them.
inline Mat3 axis_rotation(Bytes& bytes) {
  const std::uint8_t b = bytes.byte();
  Mat3 m;
  for (std::size_t i = 0; i < 3; ++i) {
    m.rows[i] = {};
    m.rows[i][(i + b) % 3] = (b >> (4U + i) & 1U) != 0 ? 1 : -1;
  }
  if (b % 8 > 3) std::swap(m.rows[0], m.rows[1]);
  return m;
}

inline Mat3 any_rotation(Bytes& bytes) {
  const double w = small_integer(bytes);
  const double x = small_integer(bytes);
  const double y = small_integer(bytes);
  const double z = small_integer(bytes);
  return w * w + x * x + y * y + z * z == 0 ? Mat3::identity()
                                            : rotation_from_quaternion(w, x, y, z);
}

inline Mat3 matrix_from(Bytes& bytes, const Mat3& before) {
  Mat3 m;
  switch (bytes.below(10)) {
    case 0:
    case 1:
      return m;
    case 2:
    case 3:
      return axis_rotation(bytes);
    case 4:
    case 5:
      return any_rotation(bytes);
    case 6:  // a small turn
      return rotation_about({0.6, 0, 0.8}, small_integer(bytes) * 1e-4) * before;
    case 7: {  // nearly a rotation
      m = any_rotation(bytes);
      const double off = std::ldexp(small_integer(bytes), -20 - static_cast<int>(bytes.below(40)));
      m.rows[bytes.below(3)][bytes.below(3)] += off;
      return m;
    }
    case 8: {  // any matrix of small numbers, singular ones too
      for (Vec3& row : m.rows) {
        for (std::size_t i = 0; i < 3; ++i) row[i] = bytes.below(5) - 2.0;
      }
      return m;
    }
    default:
      m.rows[bytes.below(3)][bytes.below(3)] = bytes.any_double();
      return m;
  }
}

/// The pose that follows `before` on the way of the second body.
inline convex::PairPose pose_from(Bytes& bytes,
                                  const convex::ConvexBody& first,
                                  const convex::ConvexBody& second,
                                  const convex::PairPose& before) {
  convex::PairPose pose{matrix_from(bytes, before.rotation), before.translation};
  const double size = first.radius_mm() + second.radius_mm();
  const std::size_t axis = bytes.below(3);
  switch (bytes.below(10)) {
    case 0:  // stays where it is, or one unit in the last place off
      break;
    case 1:  // a small step
      pose.translation[axis] += small_integer(bytes) * size * 1e-4;
      return pose;
    case 2:
      for (std::size_t i = 0; i < 3; ++i) pose.translation[i] = 0.5 * (bytes.below(25) - 12.0);
      break;
    case 3:  // far away
      pose.translation[axis] = std::ldexp(small_integer(bytes), bytes.byte());
      return pose;
    case 4:
      pose.translation[axis] = bytes.any_double();
      return pose;
    case 5:
      pose.translation = first.interior_point() - pose.rotation * second.interior_point();
      pose.translation[axis] += small_integer(bytes) * size * 0x1p-8;
      return pose;
    default: {  // features touch, but for rounding
      const Vec3 on_first = feature_of(bytes, first);
      pose.translation = on_first - pose.rotation * feature_of(bytes, second);
    }
  }
  constexpr std::array kGaps{0.0, 0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-6, -1e-6};
  const std::uint8_t b = bytes.byte();
  pose.translation[axis] += kGaps[b % 8U] * size;
  if (b >= 128) {
    pose.translation[axis] =
        std::nextafter(pose.translation[axis], b >= 192 ? HUGE_VAL : -HUGE_VAL);
  }
  return pose;
}

}  // namespace carpus::fuzz
