// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/exact_number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/rng.hpp"
#include "geometry/predicates.hpp"

namespace carpus {
namespace {

ExactNumber of(double v) { return ExactNumber(v); }

/// Doubles of all magnitudes that occur, round numbers and zeros among them.
double any_double(Rng& rng) {
  const std::uint64_t kind = rng.below(6);
  if (kind == 0) return static_cast<double>(rng.below(9)) - 4;
  if (kind == 1) return std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(600)) - 300);
  if (kind == 2) return std::ldexp(1.0, static_cast<int>(rng.below(128)) - 64);
  return rng.uniform(-40, 40);
}

TEST(ExactNumber, AgreesWithIntegersWhereTheyAreExact) {
  Rng rng(1);
  for (int i = 0; i < 3000; ++i) {
    const auto a = static_cast<std::int64_t>(rng.below(1ULL << 31U)) - (1LL << 30);
    const auto b = static_cast<std::int64_t>(rng.below(1ULL << 31U)) - (1LL << 30);
    const ExactNumber x = of(static_cast<double>(a));
    const ExactNumber y = of(static_cast<double>(b));
    const std::int64_t expected = a * b - b * b + 3 * a;
    const ExactNumber value = x * y - y * y + of(3) * x;
    EXPECT_EQ(value.sign(), expected > 0 ? 1 : (expected < 0 ? -1 : 0));
    const double rounded = value.to_double();
    EXPECT_LE(std::abs(rounded - static_cast<double>(expected)), 0x1p-52 * std::abs(rounded));
    // The rest after taking the high part away is exact as well.
    const std::int64_t high = expected / 65536 * 65536;
    EXPECT_EQ((value - of(static_cast<double>(high))).to_double(),
              static_cast<double>(expected - high));
  }
}

TEST(ExactNumber, FollowsTheLawsOfArithmeticForAllMagnitudes) {
  Rng rng(2);
  for (int i = 0; i < 3000; ++i) {
    const ExactNumber a = of(any_double(rng));
    const ExactNumber b = of(any_double(rng));
    const ExactNumber c = of(any_double(rng));
    EXPECT_EQ(((a + b) * c - (a * c + b * c)).sign(), 0);
    EXPECT_EQ(((a + b) - b - a).sign(), 0);
    EXPECT_EQ(((a + b) * (a - b) - (a * a - b * b)).sign(), 0);
    EXPECT_EQ((a * b - c).sign(), -(c - b * a).sign());
    EXPECT_EQ((-(a * a)).sign(), a.sign() == 0 ? 0 : -1);
  }
}

TEST(ExactNumber, SeesTheLastBitBesideTheLargest) {
  const ExactNumber large = of(0x1p900);
  const ExactNumber small = of(0x1p-1074);
  EXPECT_EQ((large + small - large - small).sign(), 0);
  EXPECT_EQ((large - small - large).sign(), -1);
  EXPECT_EQ((large - (large - small)).to_double(), 0x1p-1074);
  EXPECT_EQ(of(0x1p-1074).to_double(), 0x1p-1074);
  EXPECT_EQ(of(-1.7e308).to_double(), -1.7e308);
}

TEST(ExactNumber, RoundsToTheNeighbouringDouble) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const double v = any_double(rng);
    EXPECT_EQ(of(v).to_double(), v);
    const double w = any_double(rng);
    const ExactNumber product = of(v) * of(w);
    EXPECT_LE(std::abs(product.to_double() - v * w), 0x1p-51 * std::abs(v * w));
    const double scaled = std::abs(product.scaled_double(product.scale()));
    if (product.sign() != 0) {
      EXPECT_GE(scaled, 1);
      EXPECT_LE(scaled, 0x1p64);
    }
  }
}

TEST(ExactNumber, GivesTheSignsOfThePredicates) {
  Rng rng(4);
  for (int i = 0; i < 400; ++i) {
    const auto corner = [&] {
      return Vec3{rng.uniform(0, 1) + 1e6, static_cast<double>(rng.below(3)), rng.uniform(0, 1)};
    };
    const Vec3 a = corner();
    const Vec3 b = corner();
    const Vec3 c = corner();
    const Vec3 d = rng.below(2) == 0 ? a + (b - a) * 0.5 + (c - a) * 0.25 : corner();
    const ExactVec3 o(a);
    const ExactNumber det = dot(cross(ExactVec3(b) - o, ExactVec3(c) - o), ExactVec3(d) - o);
    EXPECT_EQ(det.sign(), orient3d_exact(a, b, c, d));
  }
}

TEST(ExactNumber, SaysWhereAProductDoesNotFit) {
  ExactNumber wide = of(1) + of(0x1p-1000);
  for (int i = 0; i < 12 && !wide.is_overflown(); ++i) wide = wide * wide;
  EXPECT_TRUE(wide.is_overflown());
  EXPECT_TRUE((wide - wide).is_overflown());
  EXPECT_TRUE((wide * of(2)).is_overflown());
}

TEST(ExactNumber, GivesADirectionForFilters) {
  const ExactVec3 v(of(0x1p600) * of(0x1p600), of(-3) * of(0x1p600) * of(0x1p598), of(1e-300));
  const Vec3 d = rounded_direction(v);
  EXPECT_EQ(d.y / d.x, -0.75);
  EXPECT_EQ(d.z, 0);
  EXPECT_EQ(rounded_direction(ExactVec3(Vec3{})), Vec3{});
}

}  // namespace
}  // namespace carpus
