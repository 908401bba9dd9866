// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Eigenvalues and eigenvectors of small symmetric matrices, by Eigen: of point clouds' spreads and
// of Horn's quaternion. Before an exercise only, never in a tick.
#pragma once

#include <array>
#include <cstddef>

namespace carpus::anatomy {

template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

/// values[k] belongs to the unit vector vectors[k], whose sign is either; greatest value first.
template <std::size_t N>
struct SymmetricEigen {
  std::array<double, N> values{};
  std::array<std::array<double, N>, N> vectors{};
};

/// Eigen decomposition of the symmetric matrix `a` (its upper triangle counts); N is 3 or 4.
template <std::size_t N>
[[nodiscard]] SymmetricEigen<N> eigen_of_symmetric(const SquareMatrix<N>& a);

extern template SymmetricEigen<3> eigen_of_symmetric(const SquareMatrix<3>& a);
extern template SymmetricEigen<4> eigen_of_symmetric(const SquareMatrix<4>& a);

}  // namespace carpus::anatomy
