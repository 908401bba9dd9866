// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/detail/largest_eigenvalue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/rng.hpp"
#include "geometry/mat3.hpp"
#include "geometry/vec3.hpp"

namespace carpus::imaging::detail {
namespace {

TEST(LargestEigenvalue, SolvesTheCharacteristicEquationAndBoundsTheQuadraticForm) {
  Rng rng(4);
  for (int trial = 0; trial < 2000; ++trial) {
    const double xx = rng.uniform(-5, 5), yy = rng.uniform(-5, 5), zz = rng.uniform(-5, 5);
    const double xy = rng.uniform(-5, 5), xz = rng.uniform(-5, 5), yz = rng.uniform(-5, 5);
    const double e = largest_eigenvalue(xx, yy, zz, xy, xz, yz);
    const Mat3 m{{Vec3{xx - e, xy, xz}, Vec3{xy, yy - e, yz}, Vec3{xz, yz, zz - e}}};
    ASSERT_NEAR(m.determinant(), 0.0, 1e-9 * 1000);
    const Vec3 u = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
    ASSERT_LE(dot(u, m * u), 1e-9);
  }
  EXPECT_EQ(largest_eigenvalue(2, 2, 2, 0, 0, 0), 2.0);
}

TEST(LargestEigenvalue, IsFoundOfDiagonalsInAnyOrderAndOfTwins) {
  // Where the two largest are the same the closed form itself knows r to the square root of
  // rounding.
  const auto is_largest = [](double a, double b, double c) {
    const double most = std::max({a, b, c});
    const double size = std::max({std::abs(a), std::abs(b), std::abs(c)});
    EXPECT_NEAR(largest_eigenvalue(a, b, c, 0, 0, 0), most, 3e-8 * size);
  };
  for (const double a : {-3.0, -1e-3, 0.0, 1e-9, 1.0, 700.0}) {
    for (const double b : {-3.0, 0.0, 1.0, 1.0 + 1e-9}) {
      is_largest(a, b, b);
      is_largest(b, a, b);
      is_largest(b, b, a);
      is_largest(a, b, -a);
    }
  }
}

TEST(LargestEigenvalue, OfARowIsThatOfEachMatrix) {
  for (const std::size_t count : {1U, 7U, 16U, 33U}) {
    Rng rng(count);
    std::array<std::vector<float>, 6> entries;
    std::array<const float*, 6> rows{};
    for (std::size_t k = 0; k < 6; ++k) {
      for (std::size_t i = 0; i < count; ++i) {
        entries[k].push_back(static_cast<float>(rng.uniform(-300, 300)));
      }
      rows[k] = entries[k].data();
    }
    std::vector<float> found(count);
    largest_eigenvalues(rows, found.data(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const double wanted = largest_eigenvalue(rows[0][i], rows[1][i], rows[2][i], rows[3][i],
                                               rows[4][i], rows[5][i]);
      EXPECT_EQ(found[i], static_cast<float>(wanted));
    }
  }
}

}  // namespace
}  // namespace carpus::imaging::detail
