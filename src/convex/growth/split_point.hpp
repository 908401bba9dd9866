// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A point of a placed body in two parts, the larger one without any rounding: where two such points
// all but coincide their difference is right to about 70 bits of the coordinates' size, by doubles
// alone. Numbers of twice the digits (closest/double_double.hpp) keep 100 bits, for far more work.
// Source: splitting at a common unit, [rump2008accurate] §3.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// The nearest multiple of a unit.
class NearestMultiple {
 public:
  /// @param unit  a power of two; numbers must be below 2^51 of it.
  explicit constexpr NearestMultiple(double unit) noexcept : shift_(unit * 0x1.8p52) {}
  [[nodiscard]] constexpr double operator()(double x) const noexcept {
    return (x + shift_) - shift_;
  }
  [[nodiscard]] constexpr Vec3 operator()(const Vec3& v) const noexcept {
    return {(*this)(v.x), (*this)(v.y), (*this)(v.z)};
  }

 private:
  double shift_;
};

/// Shares of a feature's corners are multiples of this.
inline constexpr double kShareUnit = 0x1p-26;

/// The least power of two above |x|; for normal numbers.
[[nodiscard]] inline double power_of_two_above(double x) noexcept {
  constexpr std::uint64_t kExponent = 0x7ff0'0000'0000'0000;
  return 2 * std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & kExponent);
}

/// high + low [mm]; high is exact, a multiple of size * 2^-48.
struct SplitPoint {
  Vec3 high;
  Vec3 low;

  /// The difference of two points of one size, right to this share of the size and a rounding of
  /// its own. Low parts: a matrix's rest times a point, 3 * 2^-25; a matrix times a point's rest,
  /// 3.1 * 2 * 2^-25; each with under 12 roundings, on both sides: under 512 * 2^-53 * 2^-25.
  static constexpr double kError = 0x1p-69;
  [[nodiscard]] Vec3 minus(const SplitPoint& other) const noexcept {
    return (high - other.high) + (low - other.low);
  }
};

/// A point between a body's vertices [mm, the body's frame].
template <std::size_t kCorners>
struct CornerShares {
  std::array<Vec3, kCorners> corners{};
  /// Of the second corner and so on: >= 0, multiples of kShareUnit, their sum at most 1.
  std::array<double, kCorners> shares{};
};

/// The point where the rotation and the translation put it.
/// @param size  a power of two [mm] that no coordinate of a corner exceeds, nor an eighth of any of
///     the translation; the rotation's squared norm is at most kMostSquaredNorm.
/// @param is_turned  false if the rotation is the identity.
/// Exact are: sums of the corners' parts of 25 bits with shares of 27; the product of a rotation's
/// part of 25 bits and a point's part of 25 bits; the sum of three of these and the translation's.
template <std::size_t kCorners>
[[nodiscard]] inline SplitPoint split_point(const CornerShares<kCorners>& of_body,
                                            const Mat3& rotation,
                                            bool is_turned,
                                            const Vec3& translation,
                                            double size) noexcept {
  const NearestMultiple coarse(size * 0x1p-24);
  const NearestMultiple fine(size * 0x1p-48);
  Vec3 point = of_body.corners[0];
  Vec3 rest;
  if constexpr (kCorners > 1) {
    const Vec3 from = coarse(point);
    const Vec3 from_rest = point - from;
    point = from;
    rest = from_rest;
    for (std::size_t i = 1; i < kCorners; ++i) {
      const Vec3 to = coarse(of_body.corners[i]);
      point += (to - from) * of_body.shares[i];
      rest += ((of_body.corners[i] - to) - from_rest) * of_body.shares[i];
    }
  }
  const Vec3 shift = fine(translation);
  const Vec3 shift_rest = translation - shift;
  if (!is_turned) {
    const Vec3 high = fine(point);
    return {high + shift, (point - high) + rest + shift_rest};
  }
  const NearestMultiple matrix(0x1p-24);
  const Vec3 high = coarse(point);
  const Vec3 low = (point - high) + rest;
  const auto& r = rotation.rows;
  const Mat3 large{{matrix(r[0]), matrix(r[1]), matrix(r[2])}};
  const Mat3 small{{r[0] - large.rows[0], r[1] - large.rows[1], r[2] - large.rows[2]}};
  return {large * high + shift, small * high + rotation * low + shift_rest};
}

}  // namespace carpus::convex
