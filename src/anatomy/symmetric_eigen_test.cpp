// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/symmetric_eigen.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/rng.hpp"

namespace carpus::anatomy {
namespace {

RC_GTEST_PROP(SymmetricEigen, GivesOrthonormalVectorsThatTheMatrixScales, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  SquareMatrix<4> a{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i; j < 4; ++j) a[i][j] = a[j][i] = rng.uniform(-10, 10);
  }
  const auto e = eigen_of_symmetric<4>(a);
  for (std::size_t k = 0; k < 4; ++k) {
    if (k > 0) RC_ASSERT(e.values[k - 1] >= e.values[k]);
    for (std::size_t i = 0; i < 4; ++i) {
      double product = 0;
      for (std::size_t j = 0; j < 4; ++j) product += a[i][j] * e.vectors[k][j];
      RC_ASSERT(std::abs(product - e.values[k] * e.vectors[k][i]) < 1e-10);
    }
    for (std::size_t l = 0; l < 4; ++l) {
      double inner = 0;
      for (std::size_t j = 0; j < 4; ++j) inner += e.vectors[k][j] * e.vectors[l][j];
      RC_ASSERT(std::abs(inner - (k == l ? 1 : 0)) < 1e-12);
    }
  }
}

TEST(SymmetricEigen, OfADiagonalMatrixAreItsEntriesFromTheGreatest) {
  const auto e = eigen_of_symmetric<3>({{{2, 0, 0}, {0, 0, 0}, {0, 0, 5}}});
  EXPECT_EQ(e.values, (std::array<double, 3>{5, 2, 0}));
  EXPECT_EQ(std::abs(e.vectors[0][2]), 1);
}

}  // namespace
}  // namespace carpus::anatomy
