// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Eigenvalues and eigenvectors of small symmetric matrices by cyclic Jacobi rotations
// [golub2013matrix] §8.5: simple, and accurate to the last digits for any symmetric input.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carpus::anatomy {

template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

/// values[k] belongs to the unit vector vectors[k]; greatest value first.
template <std::size_t N>
struct SymmetricEigen {
  std::array<double, N> values{};
  std::array<std::array<double, N>, N> vectors{};
};

/// Eigen decomposition of the symmetric matrix `a` (its upper triangle counts).
template <std::size_t N>
[[nodiscard]] SymmetricEigen<N> eigen_of_symmetric(SquareMatrix<N> a) noexcept {
  // Convergence is quadratic; ten sweeps are far more than any 4 x 4 matrix needs.
  constexpr int kMaxSweeps = 30;
  SquareMatrix<N> v{};
  for (std::size_t i = 0; i < N; ++i) v[i][i] = 1;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < i; ++j) a[i][j] = a[j][i];
  }
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double off = 0;
    for (std::size_t p = 0; p < N; ++p) {
      for (std::size_t q = p + 1; q < N; ++q) {
        off += std::abs(a[p][q]);
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1);
        const double s = t * c;
        for (std::size_t k = 0; k < N; ++k) {
          const double kp = a[k][p];
          const double kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < N; ++k) {
          const double pk = a[p][k];
          const double qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
          const double vp = v[p][k];
          const double vq = v[q][k];
          v[p][k] = c * vp - s * vq;
          v[q][k] = s * vp + c * vq;
        }
      }
    }
    if (off == 0) break;
  }
  std::array<std::size_t, N> order{};
  for (std::size_t i = 0; i < N; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return a[i][i] > a[j][j]; });
  SymmetricEigen<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    result.values[i] = a[order[i]][order[i]];
    result.vectors[i] = v[order[i]];
  }
  return result;
}

}  // namespace carpus::anatomy
