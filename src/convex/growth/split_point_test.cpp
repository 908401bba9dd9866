// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/split_point.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "convex/bodies_test_support.hpp"
#include "core/rng.hpp"
#include "geometry/exact_number.hpp"

namespace carpus::convex {
namespace {

Vec3 in_cube(Rng& rng, double half) {
  return {rng.uniform(-half, half), rng.uniform(-half, half), rng.uniform(-half, half)};
}

template <std::size_t kCorners>
struct Placed {
  CornerShares<kCorners> of_body;
  Mat3 rotation;
  bool is_turned = false;
  Vec3 translation;

  Placed(Rng& rng, double size) {
    for (Vec3& corner : of_body.corners) corner = in_cube(rng, size);
    const NearestMultiple grid(kShareUnit);
    double left = 1;
    for (std::size_t i = 1; i < kCorners; ++i) {
      of_body.shares[i] = grid(rng.uniform(0, left));
      left -= of_body.shares[i];
    }
    is_turned = rng.below(3) != 0;
    if (is_turned) rotation = test::random_rotation(rng);
    translation = in_cube(rng, 8 * size);
  }
  [[nodiscard]] SplitPoint split(double size) const {
    return split_point(of_body, rotation, is_turned, translation, size);
  }
  [[nodiscard]] ExactVec3 exact() const {
    const ExactVec3 from(of_body.corners[0]);
    ExactVec3 p = from;
    for (std::size_t i = 1; i < kCorners; ++i) {
      p = p + (ExactVec3(of_body.corners[i]) - from) * ExactNumber(of_body.shares[i]);
    }
    const auto component = [&](std::size_t i) {
      return dot(ExactVec3(rotation.rows[i]), p) + ExactNumber(translation[i]);
    };
    return {component(0), component(1), component(2)};
  }
};

/// 1; or 0, and nothing is looked at, where the points cannot be put on each other.
template <std::size_t kFirst, std::size_t kSecond>
int expect_right_difference(Rng& rng, double size) {
  const Placed<kFirst> a(rng, size);
  Placed<kSecond> b(rng, size);
  // All but on each other.
  const ExactVec3 apart = b.exact() - a.exact();
  const Vec3 moved{apart.x.to_double(), apart.y.to_double(), apart.z.to_double()};
  b.translation -= moved;
  if (std::abs(b.translation.x) > 8 * size || std::abs(b.translation.y) > 8 * size ||
      std::abs(b.translation.z) > 8 * size) {
    return 0;
  }
  const SplitPoint split = b.split(size);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(std::remainder(split.high[i], size * 0x1p-48), 0);
  }
  const Vec3 w = split.minus(a.split(size));
  const ExactVec3 off = b.exact() - a.exact() - ExactVec3(w);
  for (const ExactNumber& c : {off.x, off.y, off.z}) {
    EXPECT_LE(std::abs(c.to_double()), SplitPoint::kError * size + 0x1p-53 * length(w));
  }
  EXPECT_LT(length(w), 0x1p-46 * size);  // what is left is rounding, and is told
  return 1;
}

TEST(SplitPoint, GivesTheDifferenceOfPointsThatAllButCoincide) {
  Rng rng(71);
  int looked_at = 0;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::ldexp(1, static_cast<int>(rng.below(120)) - 40);
    looked_at += expect_right_difference<1, 3>(rng, size);
    looked_at += expect_right_difference<2, 2>(rng, size);
    looked_at += expect_right_difference<3, 1>(rng, size);
  }
  EXPECT_GT(looked_at, 5000);
}

TEST(SplitPoint, TakesSharesAtTheirEnds) {
  CornerShares<3> of_body{{Vec3{0.1, 0.2, 0.3}, Vec3{-0.7, 0.9, 0.5}, Vec3{0.6, -0.1, 0.2}}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    of_body.shares = {};
    of_body.shares[k] = 1;
    const SplitPoint p = split_point(of_body, Mat3::identity(), false, {1, 2, 3}, 1);
    const Vec3 sum = p.high + p.low - Vec3{1, 2, 3};
    EXPECT_LT(distance(sum, of_body.corners[k]), 1e-15);
  }
}

TEST(PowerOfTwoAbove, IsTheLeast) {
  EXPECT_EQ(power_of_two_above(1), 2);
  EXPECT_EQ(power_of_two_above(0.99), 1);
  EXPECT_EQ(power_of_two_above(63.5), 64);
  EXPECT_EQ(power_of_two_above(64), 128);
  EXPECT_EQ(power_of_two_above(0), 0);
  EXPECT_FALSE(power_of_two_above(HUGE_VAL) < HUGE_VAL);
}

}  // namespace
}  // namespace carpus::convex
