// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The closed form needs cos(acos(r) / 3), which no vector register has. With acos(r) = 2 phi and
// s = cos(phi) = sqrt((1 + r) / 2) it is cos(2 phi / 3), a function of s without a bend from 0 to 1
// (its nearest one is at s = -1), so that Chebyshev's series for it falls by 3 + sqrt(8) a term.
#include "imaging/detail/largest_eigenvalue.hpp"

#include <array>
#include <cmath>

#include "core/units.hpp"
#include "core/widest_vectors.hpp"

namespace carpus::imaging::detail {
namespace {

/// 5.8^-16 is below 1e-12.
constexpr std::size_t kTerms = 17;
using Series = std::array<double, kTerms>;

/// Of cos(2 acos(s) / 3) in 2 s - 1, the first term halved.
Series third_of_angle() {
  Series series{};
  for (std::size_t i = 0; i < kTerms; ++i) {
    const double angle = kPi * (static_cast<double>(i) + 0.5) / kTerms;
    const double value = std::cos(2.0 / 3 * std::acos(0.5 * (1 + std::cos(angle))));
    for (std::size_t k = 0; k < kTerms; ++k) {
      series[k] += (k == 0 ? 1.0 : 2.0) / kTerms * value * std::cos(static_cast<double>(k) * angle);
    }
  }
  return series;
}

struct Matrix {
  double xx, yy, zz, xy, xz, yz;
};

[[gnu::always_inline]] inline double largest_of(const Matrix& m, const Series& series) noexcept {
  const double mean = (m.xx + m.yy + m.zz) / 3;
  const double a = m.xx - mean;
  const double b = m.yy - mean;
  const double c = m.zz - mean;
  const double off = m.xy * m.xy + m.xz * m.xz + m.yz * m.yz;
  const double p = std::sqrt((a * a + b * b + c * c + 2 * off) / 6);
  const double det =
      a * (b * c - m.yz * m.yz) - m.xy * (m.xy * c - m.yz * m.xz) + m.xz * (m.xy * m.yz - b * m.xz);
  double r = det / (2 * p * p * p);
  r = r < 1.0 ? r : 1.0;  // where p is 0, too
  r = r > -1.0 ? r : -1.0;
  // Clenshaw's recurrence.
  const double t = 2 * std::sqrt(0.5 * (1 + r)) - 1;
  double sum = 0;
  double before = 0;
  for (std::size_t k = kTerms - 1; k > 0; --k) {
    const double next = series[k] + 2 * t * sum - before;
    before = sum;
    sum = next;
  }
  return mean + 2 * p * (series[0] + t * sum - before);
}

}  // namespace

CARPUS_WIDEST_VECTORS
void largest_eigenvalues(std::span<const float* const> rows, float* out, std::size_t count) {
  static const Series kSeries = third_of_angle();
  const Series series = kSeries;
  const float* xx = rows[0];
  const float* yy = rows[1];
  const float* zz = rows[2];
  const float* xy = rows[3];
  const float* xz = rows[4];
  const float* yz = rows[5];
  CARPUS_INDEPENDENT_TURNS
  for (std::size_t i = 0; i < count; ++i) {
    out[i] = static_cast<float>(largest_of({xx[i], yy[i], zz[i], xy[i], xz[i], yz[i]}, series));
  }
}

double largest_eigenvalue(double xx,
                          double yy,
                          double zz,
                          double xy,
                          double xz,
                          double yz) noexcept {
  static const Series kSeries = third_of_angle();
  return largest_of({xx, yy, zz, xy, xz, yz}, kSeries);
}

}  // namespace carpus::imaging::detail
