// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A square system of a few unknowns, by Gaussian elimination with partial pivoting
// [golub2013matrix] §3.4: the basis of a simplex method, solved afresh at every pivot.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace carpus::survey::detail {

template <std::size_t N>
class SmallLu {
 public:
  using Vector = std::array<double, N>;
  using Matrix = std::array<Vector, N>;  ///< rows

  explicit SmallLu(const Matrix& matrix) noexcept : lu_(matrix) {
    for (std::size_t i = 0; i < N; ++i) from_[i] = i;
    for (std::size_t k = 0; k < N; ++k) {
      std::size_t best = k;
      for (std::size_t i = k + 1; i < N; ++i) {
        if (std::abs(lu_[i][k]) > std::abs(lu_[best][k])) best = i;
      }
      std::swap(lu_[k], lu_[best]);
      std::swap(from_[k], from_[best]);
      const double pivot = std::abs(lu_[k][k]);
      smallest_pivot_ = k == 0 || !(pivot >= smallest_pivot_) ? pivot : smallest_pivot_;
      if (!(pivot > 0)) return;
      for (std::size_t i = k + 1; i < N; ++i) {
        const double factor = lu_[i][k] / lu_[k][k];
        lu_[i][k] = factor;
        for (std::size_t j = k + 1; j < N; ++j) lu_[i][j] -= factor * lu_[k][j];
      }
    }
  }

  /// The least magnitude on the diagonal, in the unit of the entries; 0 (or NaN) if singular, and
  /// then nothing may be solved.
  [[nodiscard]] double smallest_pivot() const noexcept { return smallest_pivot_; }

  /// x with A x = b.
  [[nodiscard]] Vector solve(const Vector& b) const noexcept {
    Vector x{};
    for (std::size_t i = 0; i < N; ++i) {
      double sum = b[from_[i]];
      for (std::size_t j = 0; j < i; ++j) sum -= lu_[i][j] * x[j];
      x[i] = sum;
    }
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t j = i + 1; j < N; ++j) x[i] -= lu_[i][j] * x[j];
      x[i] /= lu_[i][i];
    }
    return x;
  }

  /// y with A' y = c.
  [[nodiscard]] Vector solve_transposed(const Vector& c) const noexcept {
    Vector z = c;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < i; ++j) z[i] -= lu_[j][i] * z[j];
      z[i] /= lu_[i][i];
    }
    Vector y{};
    for (std::size_t i = N; i-- > 0;) {
      for (std::size_t j = i + 1; j < N; ++j) z[i] -= lu_[j][i] * z[j];
      y[from_[i]] = z[i];
    }
    return y;
  }

 private:
  Matrix lu_;
  std::array<std::size_t, N> from_{};
  double smallest_pivot_ = 0;
};

}  // namespace carpus::survey::detail
