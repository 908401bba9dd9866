// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Several Gaussian derivatives of one volume in a single sweep: the passes they share are done
// once, and only as many intermediate planes are in memory as a kernel reaches. Private to imaging.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "imaging/block_view.hpp"

namespace carpus::imaging::detail {

/// Order of differentiation along x, y, z; each 0, 1 or 2.
using DerivativeOrder = std::array<int, 3>;

/// Odd-sized correlation kernel of a Gaussian of `sigma` samples, differentiated `order` times.
/// Moments are exact: order 0 keeps a constant, 1 measures the slope of a ramp, 2 the second
/// derivative of a parabola, however coarse the sampling is against sigma. sigma = 0 is allowed for
/// order 0 only (identity).
[[nodiscard]] std::vector<float> gaussian_kernel(double sigma, int order);

/// Makes one output row of `count` values from one row per requested derivative.
using CombineRows =
    std::function<void(std::span<const float* const> rows, float* out, std::size_t count)>;

/// Computes the derivatives `orders` (per mm) of `input` smoothed with sigma_mm, and hands them row
/// by row to `combine`, which writes the result. Borders are mirrored about the volume's face.
template <typename T>  // float, std::int16_t
void filter_derivatives(const BlockView<T>& input,
                        double sigma_mm,
                        std::span<const DerivativeOrder> orders,
                        const CombineRows& combine,
                        std::span<float> output);

}  // namespace carpus::imaging::detail
