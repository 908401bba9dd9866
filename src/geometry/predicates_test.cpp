// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/predicates.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <utility>

#include "core/rng.hpp"

namespace carpus {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Points = std::array<Vec3, 4>;

/// The sign in rational arithmetic, straight from the definition.
int oracle3(const Points& p) {
  std::array<std::array<Rational, 3>, 3> m;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m[row][axis] = Rational(p[row + 1][axis]) - Rational(p[0][axis]);
    }
  }
  const Rational det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return det.sign();
}

int oracle2(const Vec2& a, const Vec2& b, const Vec2& c) {
  return ((Rational(b.x) - Rational(a.x)) * (Rational(c.y) - Rational(a.y)) -
          (Rational(b.y) - Rational(a.y)) * (Rational(c.x) - Rational(a.x)))
      .sign();
}

double nudged(double x, Rng& rng) {
  for (std::uint64_t steps = rng.below(3); steps > 0; --steps) {
    x = std::nextafter(x, rng.below(2) == 0 ? 1e300 : -1e300);
  }
  return x;
}

/// Points in or within a few units in the last place of one plane, of many kinds.
Points nearly_coplanar(Rng& rng) {
  const auto number = [&](std::uint64_t kind) {
    if (kind == 0) return static_cast<double>(rng.below(5));               // voxels
    if (kind == 1) return 0.4 * static_cast<double>(rng.below(50)) - 7.3;  // CT spacing
    if (kind == 2) return rng.uniform(-100, 100);
    return std::ldexp(rng.uniform(-1, 1), static_cast<int>(rng.below(120)) - 60);
  };
  const std::uint64_t kind = rng.below(4);
  Points p;
  for (Vec3& v : p) v = {number(kind), number(kind), number(kind)};
  if (rng.below(4) != 0) {
    const double s = rng.uniform(-2, 2);
    const double t = rng.uniform(-2, 2);
    p[3] = p[0] + (p[1] - p[0]) * s + (p[2] - p[0]) * t;
    for (std::size_t axis = 0; axis < 3; ++axis) p[3][axis] = nudged(p[3][axis], rng);
  }
  return p;
}

TEST(Predicates, AgreeWithRationalArithmeticOnNearlyCoplanarPoints) {
  Rng rng(7);
  int zeros = 0;
  int filtered = 0;
  for (int i = 0; i < 20000; ++i) {
    const Points p = nearly_coplanar(rng);
    const int expected = oracle3(p);
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), expected) << i;
    ASSERT_EQ(orient3d_exact(p[0], p[1], p[2], p[3]), expected) << i;
    const int filter = orient3d_filter(p[0], p[1], p[2], p[3]);
    ASSERT_TRUE(filter == 0 || filter == expected) << i;
    zeros += expected == 0;
    filtered += filter != 0;
  }
  EXPECT_GT(zeros, 500);  // the exact path was really needed
  EXPECT_GT(filtered, 4000);
}

TEST(Predicates, AreExactOverTheWholeRangeOfCoordinates) {
  Rng rng(8);
  for (int i = 0; i < 3000; ++i) {
    Points p;
    const auto number = [&] {
      const double sign = rng.below(2) == 0 ? -1.0 : 1.0;
      return rng.below(6) == 0 ? 0.0 : sign * std::pow(10.0, rng.uniform(-100, 100)) * 0.999;
    };
    for (Vec3& v : p) v = {number(), number(), number()};
    if (rng.below(2) == 0) p[3] = p[0] + (p[1] - p[0]) * 0.5;  // rounded: nearly coplanar
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), oracle3(p)) << i;
    ASSERT_EQ(orient3d_exact(p[0], p[1], p[2], p[3]), oracle3(p)) << i;
  }
}

TEST(Predicates, SeeOneUnitInTheLastPlace) {
  const Vec3 a{0.1, 0.2, 0.3};
  const Vec3 b{1.1, 0.2, 0.3};
  const Vec3 c{0.1, 1.2, 0.3};
  EXPECT_EQ(orient3d(a, b, c, {0.7, 0.4, 0.3}), 0);
  EXPECT_EQ(orient3d(a, b, c, {0.7, 0.4, std::nextafter(0.3, 1.0)}), 1);
  EXPECT_EQ(orient3d(a, b, c, {0.7, 0.4, std::nextafter(0.3, 0.0)}), -1);
}

TEST(Predicates, ChangeSignWithEachSwap) {
  Rng rng(9);
  for (int i = 0; i < 5000; ++i) {
    Points p = nearly_coplanar(rng);
    const int sign = orient3d(p[0], p[1], p[2], p[3]);
    const std::size_t j = rng.below(4);
    const std::size_t k = (j + 1 + rng.below(3)) % 4;
    std::swap(p[j], p[k]);
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), -sign);
  }
}

TEST(Predicates, KnowTheTurnOfThreePointsInThePlane) {
  Rng rng(10);
  for (int i = 0; i < 20000; ++i) {
    const Points p = nearly_coplanar(rng);
    const Vec2 a{p[0].x, p[0].y};
    const Vec2 b{p[1].x, p[1].y};
    const double s = rng.uniform(-2, 2);
    const Vec2 c{nudged(a.x + (b.x - a.x) * s, rng), nudged(a.y + (b.y - a.y) * s, rng)};
    ASSERT_EQ(orient2d(a, b, c), oracle2(a, b, c)) << i;
    ASSERT_EQ(orient2d(a, b, c), -orient2d(b, a, c)) << i;
  }
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
}

TEST(Predicates, RecogniseCollinearPoints) {
  EXPECT_TRUE(are_collinear({1, 2, 3}, {2, 4, 6}, {-3, -6, -9}));
  EXPECT_TRUE(are_collinear({1, 2, 3}, {1, 2, 3}, {5, 5, 5}));
  EXPECT_FALSE(are_collinear({0, 0, 0}, {1, 0, 0}, {2, 0, 1e-90}));
}

}  // namespace
}  // namespace carpus
