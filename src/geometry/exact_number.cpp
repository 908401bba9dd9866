// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/exact_number.hpp"

#include <cmath>

namespace carpus {
namespace {

// 64 x 64 bits -> 128; both compilers know it, ISO C++ does not.
__extension__ using Wide = unsigned __int128;

constexpr std::int32_t floor_div_64(std::int32_t a) noexcept { return (a >= 0 ? a : a - 63) / 64; }

}  // namespace

ExactNumber::ExactNumber(double value) noexcept {
  if (value == 0) return;
  sign_ = value > 0 ? 1 : -1;
  int exponent = 0;
  const double fraction = std::frexp(std::abs(value), &exponent);
  const auto bits = static_cast<std::uint64_t>(std::ldexp(fraction, 53));  // exact
  const std::int32_t low = exponent - 53;                                  // value = bits * 2^low
  exponent_ = floor_div_64(low);
  const auto shift = static_cast<unsigned>(low - 64 * exponent_);
  limbs_[0] = bits << shift;
  limbs_[1] = shift == 0 ? 0 : bits >> (64U - shift);
  count_ = 2;
  trim();
}

ExactNumber ExactNumber::overflown() noexcept {
  ExactNumber result;
  result.exponent_ = kOverflown;
  return result;
}

void ExactNumber::trim() noexcept {
  while (count_ > 0 && limbs_[static_cast<std::size_t>(count_ - 1)] == 0) --count_;
  std::int32_t zeros = 0;
  while (zeros < count_ && limbs_[static_cast<std::size_t>(zeros)] == 0) ++zeros;
  if (zeros > 0) {
    std::copy(limbs_.begin() + zeros, limbs_.begin() + count_, limbs_.begin());
    count_ -= zeros;
    exponent_ += zeros;
  }
  if (count_ == 0) {
    sign_ = 0;
    exponent_ = 0;
  }
}

bool ExactNumber::is_smaller_magnitude(const ExactNumber& a, const ExactNumber& b) noexcept {
  if (a.top() != b.top()) return a.top() < b.top();
  for (std::int32_t i = a.top() - 1; i >= std::min(a.exponent_, b.exponent_); --i) {
    const std::uint64_t p = a.limb_at(i);
    const std::uint64_t q = b.limb_at(i);
    if (p != q) return p < q;
  }
  return false;
}

ExactNumber ExactNumber::added(const ExactNumber& a, const ExactNumber& b) noexcept {
  const std::int32_t low = std::min(a.exponent_, b.exponent_);
  const std::int32_t high = std::max(a.top(), b.top());
  if (high - low + 1 > kLimbs) return overflown();
  ExactNumber result;
  result.exponent_ = low;
  result.sign_ = 1;
  std::uint64_t carry = 0;
  for (std::int32_t i = low; i < high; ++i) {
    const Wide s = static_cast<Wide>(a.limb_at(i)) + b.limb_at(i) + carry;
    result.limbs_[static_cast<std::size_t>(i - low)] = static_cast<std::uint64_t>(s);
    carry = static_cast<std::uint64_t>(s >> 64U);
  }
  result.limbs_[static_cast<std::size_t>(high - low)] = carry;
  result.count_ = high - low + 1;
  result.trim();
  return result;
}

ExactNumber ExactNumber::subtracted(const ExactNumber& larger,
                                    const ExactNumber& smaller) noexcept {
  const std::int32_t low = std::min(larger.exponent_, smaller.exponent_);
  const std::int32_t high = larger.top();
  if (high - low > kLimbs) return overflown();
  ExactNumber result;
  result.exponent_ = low;
  result.sign_ = 1;
  std::uint64_t borrow = 0;
  for (std::int32_t i = low; i < high; ++i) {
    const Wide d = static_cast<Wide>(larger.limb_at(i)) - smaller.limb_at(i) - borrow;
    result.limbs_[static_cast<std::size_t>(i - low)] = static_cast<std::uint64_t>(d);
    borrow = static_cast<std::uint64_t>(d >> 64U) & 1U;
  }
  result.count_ = high - low;
  result.trim();
  return result;
}

ExactNumber ExactNumber::sum(const ExactNumber& a, const ExactNumber& b, int sign_of_b) noexcept {
  if (a.is_overflown() || b.is_overflown()) return overflown();
  if (sign_of_b == 0) return a;
  if (a.sign_ == 0) {
    ExactNumber result(b);
    result.sign_ = sign_of_b;
    return result;
  }
  if (a.sign_ == sign_of_b) {
    ExactNumber result = added(a, b);
    result.sign_ *= a.sign_;
    return result;
  }
  const bool is_b_larger = is_smaller_magnitude(a, b);
  ExactNumber result = is_b_larger ? subtracted(b, a) : subtracted(a, b);
  result.sign_ *= is_b_larger ? sign_of_b : a.sign_;
  return result;
}

ExactNumber ExactNumber::product(const ExactNumber& a, const ExactNumber& b) noexcept {
  if (a.is_overflown() || b.is_overflown()) return overflown();
  ExactNumber result;
  if (a.sign_ == 0 || b.sign_ == 0) return result;
  if (a.count_ + b.count_ > kLimbs) return overflown();
  const auto rows = static_cast<std::size_t>(a.count_);
  const auto columns = static_cast<std::size_t>(b.count_);
  std::fill_n(result.limbs_.begin(), columns, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < columns; ++j) {
      const Wide p = static_cast<Wide>(a.limbs_[i]) * b.limbs_[j] + result.limbs_[i + j] + carry;
      result.limbs_[i + j] = static_cast<std::uint64_t>(p);
      carry = static_cast<std::uint64_t>(p >> 64U);
    }
    result.limbs_[i + columns] = carry;
  }
  result.count_ = a.count_ + b.count_;
  result.exponent_ = a.exponent_ + b.exponent_;
  result.sign_ = a.sign_ * b.sign_;
  result.trim();
  return result;
}

double ExactNumber::scaled_double(std::int32_t scale) const noexcept {
  if (sign_ == 0) return 0;
  // Three limbs hold at least 129 significant bits; what is below changes less than 2^-128.
  double value = 0;
  const std::int32_t last = std::max(exponent_, top() - 3);
  for (std::int32_t i = last; i < top(); ++i) {
    // A limb of 64 bits as two exact halves, so that the sum's last rounding alone counts.
    const std::uint64_t limb = limb_at(i);
    const auto high = static_cast<double>(limb >> 32U);
    const auto low = static_cast<double>(limb & 0xFFFFFFFFU);
    value += std::ldexp(low, 64 * (i - top() + 1));
    value += std::ldexp(high, 64 * (i - top() + 1) + 32);
  }
  return sign_ * std::ldexp(value, 64 * std::clamp(top() - 1 - scale, -100, 100));
}

ExactNumber dot(const ExactVec3& a, const ExactVec3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

ExactVec3 cross(const ExactVec3& a, const ExactVec3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vec3 rounded_direction(const ExactVec3& a) noexcept {
  std::int32_t scale = -(1 << 20);
  for (const ExactNumber* c : {&a.x, &a.y, &a.z}) {
    if (c->sign() != 0) scale = std::max(scale, c->scale());
  }
  return {a.x.scaled_double(scale), a.y.scaled_double(scale), a.z.scaled_double(scale)};
}

}  // namespace carpus
