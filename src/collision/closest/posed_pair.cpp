// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/closest/posed_pair.hpp"

#include "collision/closest/double_double.hpp"

namespace carpus::collision {
namespace {

/// row . v + t - c, rounded once.
double offset_along(const Vec3& row, const Vec3& v, double t, double c) noexcept {
  DoubleDouble sum = DoubleDouble::sum(t, -c);
  sum = sum + DoubleDouble::product(row.x, v.x);
  sum = sum + DoubleDouble::product(row.y, v.y);
  sum = sum + DoubleDouble::product(row.z, v.z);
  return sum.high;
}

}  // namespace

PosedPair::PosedPair(const SupportGraph& first,
                     const SupportGraph& second,
                     const PairPose& pose) noexcept
    : first_(first), second_(second), rotation_(pose.rotation) {
  const Vec3& from = second.centre();
  const Vec3& to = first.centre();
  offset_ = {offset_along(rotation_.rows[0], from, pose.translation.x, to.x),
             offset_along(rotation_.rows[1], from, pose.translation.y, to.y),
             offset_along(rotation_.rows[2], from, pose.translation.z, to.z)};
  // The matrix is used as it is given; its Frobenius norm bounds what it does to lengths (and is
  // not a number where one of its entries is not).
  const double stretch =
      std::sqrt(squared_length(rotation_.rows[0]) + squared_length(rotation_.rows[1]) +
                squared_length(rotation_.rows[2]));
  scale_mm_ = first.radius_mm() + stretch * second.radius_mm() + length(offset_);
}

}  // namespace carpus::collision
