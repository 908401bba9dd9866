// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Largest eigenvalues of many small symmetric matrices.
#pragma once

#include <cstddef>
#include <span>

namespace carpus::imaging::detail {

/// Of the symmetric matrices ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)) the largest eigenvalue, by
/// the trigonometric closed form [smith1961eigenvalues]; to 1e-11 of the largest
/// entry, where the two largest coincide to 3e-8.
/// @param rows  xx, yy, zz, xy, xz, yz, `count` of each
void largest_eigenvalues(std::span<const float* const> rows, float* out, std::size_t count);

/// The same of one matrix, unrounded.
[[nodiscard]] double largest_eigenvalue(double xx,
                                        double yy,
                                        double zz,
                                        double xy,
                                        double xz,
                                        double yz) noexcept;

}  // namespace carpus::imaging::detail
