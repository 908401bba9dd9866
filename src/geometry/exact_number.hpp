// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers that no rounding touches: sums, differences and products of doubles, for the rare proofs
// that floating point cannot give. Fixed capacity, no allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/vec3.hpp"

namespace carpus {

/// A dyadic number: sign * integer * 2^(64 * exponent). Limbs are aligned to multiples of 64 bits,
/// so that adding needs no shifts; zero limbs at both ends are left out.
///
/// Capacity: any product of four factors, each a sum of products of two or three doubles of at most
/// 2^333 (kLargestCoordinate) in magnitude and with last bits of at least 2^-1074 * 2^-386, spans
/// 4 * 35 limbs. What does not fit cannot be stored: check is_overflown() where a factor more is
/// possible.
class ExactNumber {
 public:
  static constexpr std::int32_t kLimbs = 144;

  ExactNumber() noexcept {}  // NOLINT(modernize-use-equals-default): leaves the limbs unwritten
  explicit ExactNumber(double value) noexcept;  ///< finite
  ExactNumber(const ExactNumber& other) noexcept
      : count_(other.count_), exponent_(other.exponent_), sign_(other.sign_) {
    std::copy_n(other.limbs_.begin(), count_, limbs_.begin());
  }
  ExactNumber& operator=(const ExactNumber& other) noexcept {
    if (this == &other) return *this;
    count_ = other.count_;
    exponent_ = other.exponent_;
    sign_ = other.sign_;
    std::copy_n(other.limbs_.begin(), count_, limbs_.begin());
    return *this;
  }
  ~ExactNumber() = default;

  /// -1, 0 or +1.
  [[nodiscard]] int sign() const noexcept { return sign_; }
  /// An operation did not fit and its result is meaningless; stays so in all that follows from it.
  [[nodiscard]] bool is_overflown() const noexcept { return exponent_ == kOverflown; }

  friend ExactNumber operator-(const ExactNumber& a) noexcept {
    ExactNumber result(a);
    result.sign_ = -a.sign_;
    return result;
  }
  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) noexcept {
    return sum(a, b, b.sign_);
  }
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) noexcept {
    return sum(a, b, -b.sign_);
  }
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) noexcept {
    return product(a, b);
  }

  /// The number times 2^(-64 * scale), rounded to within 2^-52 of itself (relative); exact zero is
  /// zero. Magnitudes outside the doubles become infinite or zero.
  [[nodiscard]] double scaled_double(std::int32_t scale) const noexcept;
  [[nodiscard]] double to_double() const noexcept { return scaled_double(0); }
  /// A scale at which this number's scaled_double lies in [1, 2^64); 0 for zero.
  [[nodiscard]] std::int32_t scale() const noexcept {
    return sign_ == 0 ? 0 : exponent_ + count_ - 1;
  }

 private:
  static constexpr std::int32_t kOverflown = 1 << 20;

  static ExactNumber sum(const ExactNumber& a, const ExactNumber& b, int sign_of_b) noexcept;
  static ExactNumber product(const ExactNumber& a, const ExactNumber& b) noexcept;
  static ExactNumber added(const ExactNumber& a, const ExactNumber& b) noexcept;
  static ExactNumber subtracted(const ExactNumber& larger, const ExactNumber& smaller) noexcept;
  static ExactNumber overflown() noexcept;
  /// The limb with weight 2^(64 * position).
  [[nodiscard]] std::uint64_t limb_at(std::int32_t position) const noexcept {
    const std::int32_t i = position - exponent_;
    return i >= 0 && i < count_ ? limbs_[static_cast<std::size_t>(i)] : 0;
  }
  [[nodiscard]] std::int32_t top() const noexcept { return exponent_ + count_; }
  static bool is_smaller_magnitude(const ExactNumber& a, const ExactNumber& b) noexcept;
  void trim() noexcept;

  std::array<std::uint64_t, kLimbs> limbs_;  // least first; only `count_` are written
  std::int32_t count_ = 0;
  std::int32_t exponent_ = 0;
  int sign_ = 0;
};

/// A vector of exact numbers.
struct ExactVec3 {
  ExactNumber x;
  ExactNumber y;
  ExactNumber z;

  ExactVec3() = default;
  ExactVec3(const ExactNumber& a, const ExactNumber& b, const ExactNumber& c) noexcept
      : x(a), y(b), z(c) {}
  explicit ExactVec3(const Vec3& v) noexcept : x(v.x), y(v.y), z(v.z) {}

  friend ExactVec3 operator+(const ExactVec3& a, const ExactVec3& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend ExactVec3 operator-(const ExactVec3& a, const ExactVec3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend ExactVec3 operator-(const ExactVec3& a) noexcept { return {-a.x, -a.y, -a.z}; }
  friend ExactVec3 operator*(const ExactVec3& a, const ExactNumber& s) noexcept {
    return {a.x * s, a.y * s, a.z * s};
  }
  [[nodiscard]] bool is_zero() const noexcept {
    return x.sign() == 0 && y.sign() == 0 && z.sign() == 0;
  }
};

[[nodiscard]] ExactNumber dot(const ExactVec3& a, const ExactVec3& b) noexcept;
[[nodiscard]] ExactVec3 cross(const ExactVec3& a, const ExactVec3& b) noexcept;

/// The vector divided by a power of 2^64 that brings its largest component into [1, 2^64), each
/// component rounded to within 2^-52 of itself: its direction, for filters.
[[nodiscard]] Vec3 rounded_direction(const ExactVec3& a) noexcept;

}  // namespace carpus
