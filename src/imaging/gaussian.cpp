// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/gaussian.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "imaging/detail/derivative_engine.hpp"
#include "imaging/detail/largest_eigenvalue.hpp"

namespace carpus::imaging {

using detail::DerivativeOrder;
using Rows = std::span<const float* const>;

namespace {

template <typename T>
Grid<float> smoothed(const BlockView<T>& image, double sigma_mm) {
  Grid<float> result(image.geometry());
  constexpr std::array<DerivativeOrder, 1> kOrders{{{0, 0, 0}}};
  const auto copy_row = [](Rows rows, float* out, std::size_t count) {
    std::copy_n(rows[0], count, out);
  };
  detail::filter_derivatives(image, sigma_mm, kOrders, copy_row, result.values());
  return result;
}

template <typename T>
Grid<float> gradient_of(const BlockView<T>& image, double sigma_mm) {
  Grid<float> result(image.geometry());
  constexpr std::array<DerivativeOrder, 3> kOrders{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const auto norm = [](Rows rows, float* out, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      out[i] =
          std::sqrt(rows[0][i] * rows[0][i] + rows[1][i] * rows[1][i] + rows[2][i] * rows[2][i]);
    }
  };
  detail::filter_derivatives(image, sigma_mm, kOrders, norm, result.values());
  return result;
}

template <typename T>
Grid<float> sheets_of(const BlockView<T>& image, double sigma_mm) {
  Grid<float> result(image.geometry());
  constexpr std::array<DerivativeOrder, 6> kOrders{
      {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
  const auto scale = static_cast<float>(sigma_mm * sigma_mm);
  const auto positive_eigenvalue = [scale](Rows rows, float* out, std::size_t count) {
    detail::largest_eigenvalues(rows, out, count);
    for (std::size_t i = 0; i < count; ++i) out[i] = out[i] > 0 ? scale * out[i] : 0.0F;
  };
  detail::filter_derivatives(image, sigma_mm, kOrders, positive_eigenvalue, result.values());
  return result;
}

}  // namespace

Grid<float> gaussian_smooth(const GridView<const float>& image, double sigma_mm) {
  return smoothed<float>(image, sigma_mm);
}
Grid<float> gaussian_smooth(const BlockView<std::int16_t>& image, double sigma_mm) {
  return smoothed(image, sigma_mm);
}
Grid<float> gradient_magnitude(const GridView<const float>& image, double sigma_mm) {
  return gradient_of<float>(image, sigma_mm);
}
Grid<float> gradient_magnitude(const BlockView<std::int16_t>& image, double sigma_mm) {
  return gradient_of(image, sigma_mm);
}
Grid<float> dark_sheet_measure(const GridView<const float>& image, double sigma_mm) {
  return sheets_of<float>(image, sigma_mm);
}
Grid<float> dark_sheet_measure(const BlockView<std::int16_t>& image, double sigma_mm) {
  return sheets_of(image, sigma_mm);
}

}  // namespace carpus::imaging
