// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Exact determinants as expansions: sums of doubles that do not overlap, least first, zeros left
// out, so that lattice points cost little [shewchuk1997predicates] §2. Expansions are exact only
// while nothing underflows; coordinates so small that a product could are handed to integers.
#include "geometry/predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

namespace carpus {
namespace {

/// Below this a coordinate's last bit, 2^-52 of it, cubed, would underflow.
constexpr double kLeastForExpansions = 0x1.0p-280;

/// x + y = a + b exactly, x the rounded sum.
void two_sum(double a, double b, double& x, double& y) {
  x = a + b;
  const double b_part = x - a;
  y = (a - (x - b_part)) + (b - b_part);
}

/// x + y = a * b exactly (Dekker; written without fused multiply-add so that every build agrees).
void two_product(double a, double b, double& x, double& y) {
  constexpr double kSplitter = 0x1.0p27 + 1;
  x = a * b;
  const double ca = kSplitter * a;
  const double a_high = ca - (ca - a);
  const double a_low = a - a_high;
  const double cb = kSplitter * b;
  const double b_high = cb - (cb - b);
  const double b_low = b - b_high;
  y = a_low * b_low - (((x - a_high * b_high) - a_low * b_high) - a_high * b_low);
}

/// The most components that orient3d needs: three products of 16 with 2.
constexpr std::size_t kMaxComponents = 192;

struct Expansion {
  std::array<double, kMaxComponents> part;  // only the first `count` are written
  std::size_t count = 0;

  Expansion() {}  // NOLINT(modernize-use-equals-default): leaves `part` unwritten
  void append(double value) {
    if (value != 0) part[count++] = value;
  }
  [[nodiscard]] int sign() const { return count == 0 ? 0 : (part[count - 1] > 0 ? 1 : -1); }
};

Expansion difference(double a, double b) {
  double x;
  double y;
  two_sum(a, -b, x, y);
  Expansion e;
  e.append(y);
  e.append(x);
  return e;
}

/// Shewchuk's fast expansion sum: merge by magnitude, then add from the least upwards.
Expansion sum(const Expansion& e, const Expansion& f) {
  if (e.count == 0) return f;
  if (f.count == 0) return e;
  Expansion h;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto next = [&] {
    const bool take_e = j == f.count || (i < e.count && std::abs(e.part[i]) < std::abs(f.part[j]));
    return take_e ? e.part[i++] : f.part[j++];
  };
  double q = next();
  while (i < e.count || j < f.count) {
    double rest;
    two_sum(q, next(), q, rest);
    h.append(rest);
  }
  h.append(q);
  return h;
}

Expansion negated(Expansion e) {
  for (std::size_t i = 0; i < e.count; ++i) e.part[i] = -e.part[i];
  return e;
}

Expansion scaled(const Expansion& e, double b) {
  Expansion h;
  if (e.count == 0 || b == 0) return h;
  double q;
  double rest;
  two_product(e.part[0], b, q, rest);
  h.append(rest);
  for (std::size_t i = 1; i < e.count; ++i) {
    double high;
    double low;
    two_product(e.part[i], b, high, low);
    two_sum(q, low, q, rest);
    h.append(rest);
    two_sum(high, q, q, rest);
    h.append(rest);
  }
  h.append(q);
  return h;
}

Expansion product(const Expansion& e, const Expansion& factor) {
  Expansion total;
  for (std::size_t i = 0; i < factor.count; ++i) total = sum(total, scaled(e, factor.part[i]));
  return total;
}

/// Sign and magnitude; 32-bit limbs, least first. For coordinates near the ends of the range.
class WideInteger {
 public:
  WideInteger() = default;
  /// `value` in units of 2^-1074, in which every double is an integer.
  explicit WideInteger(double value) : negative_(value < 0) {
    int exponent = 0;
    const double fraction = std::frexp(std::abs(value), &exponent);
    auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    int shift = exponent - 53 + 1074;
    if (shift < 0) {  // a subnormal: its low bits are zero
      bits >>= static_cast<unsigned>(-shift);
      shift = 0;
    }
    limbs_.assign(static_cast<std::size_t>(shift / 32), 0);
    const auto offset = static_cast<unsigned>(shift % 32);
    std::uint64_t carry = 0;
    for (const std::uint64_t half : {bits & 0xFFFFFFFFU, bits >> 32U}) {
      const std::uint64_t moved = (half << offset) | carry;
      limbs_.push_back(static_cast<std::uint32_t>(moved));
      carry = moved >> 32U;
    }
    limbs_.push_back(static_cast<std::uint32_t>(carry));
    trim();
  }

  [[nodiscard]] int sign() const { return limbs_.empty() ? 0 : (negative_ ? -1 : 1); }

  friend WideInteger operator-(WideInteger a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend WideInteger operator+(const WideInteger& a, const WideInteger& b) {
    if (a.negative_ == b.negative_) return with_sign(add(a.limbs_, b.limbs_), a.negative_);
    return is_less(a.limbs_, b.limbs_) ? with_sign(subtract(b.limbs_, a.limbs_), b.negative_)
                                       : with_sign(subtract(a.limbs_, b.limbs_), a.negative_);
  }
  friend WideInteger operator-(const WideInteger& a, const WideInteger& b) { return a + (-b); }
  friend WideInteger operator*(const WideInteger& a, const WideInteger& b) {
    Limbs product(a.limbs_.size() + b.limbs_.size(), 0);
    for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
        carry += static_cast<std::uint64_t>(a.limbs_[i]) * b.limbs_[j] + product[i + j];
        product[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32U;
      }
      product[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
    }
    return with_sign(std::move(product), a.negative_ != b.negative_);
  }

 private:
  using Limbs = std::vector<std::uint32_t>;

  static WideInteger with_sign(Limbs limbs, bool negative) {
    WideInteger result;
    result.limbs_ = std::move(limbs);
    result.negative_ = negative;
    result.trim();
    return result;
  }
  static bool is_less(const Limbs& a, const Limbs& b) {
    if (a.size() != b.size()) return a.size() < b.size();
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  }
  static Limbs add(const Limbs& a, const Limbs& b) {
    Limbs result;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < std::max(a.size(), b.size()) || carry != 0; ++i) {
      carry += (i < a.size() ? a[i] : 0U);
      carry += (i < b.size() ? b[i] : 0U);
      result.push_back(static_cast<std::uint32_t>(carry));
      carry >>= 32U;
    }
    return result;
  }
  /// a - b for a >= b.
  static Limbs subtract(const Limbs& a, const Limbs& b) {
    Limbs result;
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::int64_t d = static_cast<std::int64_t>(a[i]) -
                             (i < b.size() ? static_cast<std::int64_t>(b[i]) : 0) - borrow;
      borrow = d < 0 ? 1 : 0;
      result.push_back(static_cast<std::uint32_t>(d));
    }
    return result;
  }
  void trim() {
    while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
    if (limbs_.empty()) negative_ = false;
  }

  Limbs limbs_;
  bool negative_ = false;
};

bool may_underflow(std::initializer_list<double> coordinates) {
  return std::any_of(coordinates.begin(), coordinates.end(),
                     [](double c) { return c != 0 && std::abs(c) < kLeastForExpansions; });
}

/// The determinant of three rows, in whatever arithmetic `minus` yields.
template <typename Minus>
auto rows_minus(const Vec3& p, const Vec3& a, Minus minus) {
  return std::array{minus(p.x, a.x), minus(p.y, a.y), minus(p.z, a.z)};
}

int orient3d_by_integers(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto minus = [](double p, double q) { return WideInteger(p) - WideInteger(q); };
  const auto u = rows_minus(b, a, minus);
  const auto v = rows_minus(c, a, minus);
  const auto w = rows_minus(d, a, minus);
  return (w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
          w[2] * (u[0] * v[1] - u[1] * v[0]))
      .sign();
}

}  // namespace

int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (may_underflow({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z})) {
    return orient3d_by_integers(a, b, c, d);
  }
  const auto u = rows_minus(b, a, difference);
  const auto v = rows_minus(c, a, difference);
  const auto w = rows_minus(d, a, difference);
  const auto term = [&](std::size_t i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    if (w[i].count == 0) return Expansion();
    return product(sum(product(u[j], v[k]), negated(product(u[k], v[j]))), w[i]);
  };
  return sum(sum(term(0), term(1)), term(2)).sign();
}

int orient2d_exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  if (may_underflow({a.x, a.y, b.x, b.y, c.x, c.y})) {
    const auto minus = [](double p, double q) { return WideInteger(p) - WideInteger(q); };
    return (minus(b.x, a.x) * minus(c.y, a.y) - minus(b.y, a.y) * minus(c.x, a.x)).sign();
  }
  const Expansion left = product(difference(b.x, a.x), difference(c.y, a.y));
  const Expansion right = product(difference(b.y, a.y), difference(c.x, a.x));
  return sum(left, negated(right)).sign();
}

}  // namespace carpus
