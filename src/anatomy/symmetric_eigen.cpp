// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace carpus::anatomy {

template <std::size_t N>
SymmetricEigen<N> eigen_of_symmetric(const SquareMatrix<N>& a) {
  constexpr int n = N;
  Eigen::Matrix<double, n, n> lower;  // the triangle that the solver reads
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      lower(i, j) = a[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(lower);
  SymmetricEigen<N> result;
  for (std::size_t k = 0; k < N; ++k) {  // the solver's values rise
    const int from = n - 1 - static_cast<int>(k);
    result.values[k] = solver.eigenvalues()(from);
    for (std::size_t i = 0; i < N; ++i) {
      result.vectors[k][i] = solver.eigenvectors()(static_cast<int>(i), from);
    }
  }
  return result;
}

template SymmetricEigen<3> eigen_of_symmetric(const SquareMatrix<3>& a);
template SymmetricEigen<4> eigen_of_symmetric(const SquareMatrix<4>& a);

}  // namespace carpus::anatomy
