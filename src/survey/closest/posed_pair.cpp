// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/posed_pair.hpp"

#include <cmath>

#include "convex/double_double.hpp"

namespace carpus::survey {
namespace {

/// Frames' origins farther from the bodies than this times their size: coordinates cancel, and
/// their difference is computed with twice the digits (some 100 ns).
constexpr double kFarAway = 32;

/// row . v + t - c, rounded once.
double wide_offset(const Vec3& row, const Vec3& v, double t, double c) noexcept {
  convex::DoubleDouble sum = convex::DoubleDouble::sum(t, -c);
  sum = sum + convex::DoubleDouble::product(row.x, v.x);
  sum = sum + convex::DoubleDouble::product(row.y, v.y);
  sum = sum + convex::DoubleDouble::product(row.z, v.z);
  return sum.high;
}

double size_of(const Vec3& v) noexcept { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

}  // namespace

PosedPair::PosedPair(const convex::SupportGraph& first,
                     const convex::SupportGraph& second,
                     const convex::PairPose& pose) noexcept
    : first_(first), second_(second), rotation_(pose.rotation) {
  const Vec3& from = second.centre();
  const Vec3& to = first.centre();
  const double bodies = first.radius_mm() + second.radius_mm();
  double cancelled = size_of(from) + size_of(to) + size_of(pose.translation);
  if (cancelled <= kFarAway * bodies) {
    offset_ = rotation_ * from + (pose.translation - to);
  } else {
    offset_ = {wide_offset(rotation_.rows[0], from, pose.translation.x, to.x),
               wide_offset(rotation_.rows[1], from, pose.translation.y, to.y),
               wide_offset(rotation_.rows[2], from, pose.translation.z, to.z)};
    cancelled = 0;
  }
  // The matrix is used as it is given. (1 + F^2) / 2 >= F, its Frobenius norm, which bounds what it
  // does to lengths (and is not a number where one of its entries is not).
  const double stretch =
      0.5 + 0.5 * (squared_length(rotation_.rows[0]) + squared_length(rotation_.rows[1]) +
                   squared_length(rotation_.rows[2]));
  scale_mm_ = first.radius_mm() + stretch * second.radius_mm() + size_of(offset_);
  rounding_mm_ = 16 * kRoundoff * scale_mm_ + 8 * kRoundoff * cancelled;
}

}  // namespace carpus::survey
