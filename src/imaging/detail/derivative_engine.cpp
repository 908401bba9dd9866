// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Slice by slice: (1) correlate the slice that comes within reach along x, once for each distinct
// order in x; (2) along y, once for each distinct pair of orders; (3) along z, row by row, for each
// requested derivative; (4) combine the rows.
#include "imaging/detail/derivative_engine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/parallel.hpp"
#include "core/widest_vectors.hpp"

namespace carpus::imaging::detail {
namespace {

/// A Gaussian is cut off where it has fallen to e^-8.
constexpr double kKernelReach = 4.0;
/// Slices that one task takes at least: each begins with those that its kernels reach before them.
constexpr std::size_t kSlices = 32;
/// Values summed together; a fixed count lets the compiler use vector registers.
constexpr std::size_t kBlock = 32;

using Kernel = std::vector<float>;

int radius_of(const Kernel& kernel) { return static_cast<int>(kernel.size() / 2); }

/// Index of the sample that stands for `i` when a line of n samples is mirrored at its ends.
int mirrored(int i, int n) {
  const int period = 2 * n;
  i %= period;
  if (i < 0) i += period;
  return i < n ? i : period - 1 - i;
}

/// out[x] = sum over t of kernel[t] * rows[t][x].
CARPUS_WIDEST_VECTORS
void weighted_sum(std::span<const float* const> rows,
                  const Kernel& kernel,
                  float* out,
                  std::size_t count) {
  const auto sum_block = [&](std::size_t x) {
    std::array<float, kBlock> sum{};
    for (std::size_t t = 0; t < kernel.size(); ++t) {
      const float weight = kernel[t];
      const float* row = rows[t] + x;
      for (std::size_t i = 0; i < kBlock; ++i) sum[i] += weight * row[i];
    }
    for (std::size_t i = 0; i < kBlock; ++i) out[x + i] = sum[i];
  };
  if (count >= kBlock) {
    for (std::size_t x = 0; x + kBlock <= count; x += kBlock) sum_block(x);
    sum_block(count - kBlock);  // the rest, and some of it again
    return;
  }
  for (std::size_t x = 0; x < count; ++x) {
    float sum = 0;
    for (std::size_t t = 0; t < kernel.size(); ++t) sum += kernel[t] * rows[t][x];
    out[x] = sum;
  }
}

/// Everything that does not change from slab to slab.
struct Plan {
  GridGeometry geometry;
  std::array<std::array<Kernel, 3>, 3> kernels;  ///< [axis][order]
  std::vector<std::pair<int, int>> xy_pairs;     ///< distinct orders in x and y, sorted
  std::vector<std::size_t> pair_of_order;        ///< index into xy_pairs per requested derivative
  std::vector<DerivativeOrder> orders;

  [[nodiscard]] std::size_t nx() const { return static_cast<std::size_t>(geometry.size[0]); }
  [[nodiscard]] std::size_t ny() const { return static_cast<std::size_t>(geometry.size[1]); }
  [[nodiscard]] std::size_t plane() const { return nx() * ny(); }
};

Plan make_plan(const GridGeometry& geometry,
               double sigma_mm,
               std::span<const DerivativeOrder> orders) {
  Plan plan{geometry, {}, {}, {}, {orders.begin(), orders.end()}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double spacing = geometry.spacing[axis];
    for (const DerivativeOrder& order : orders) {
      const int n = order[axis];
      Kernel& kernel = plan.kernels[axis][static_cast<std::size_t>(n)];
      if (!kernel.empty()) continue;
      kernel = gaussian_kernel(sigma_mm / spacing, n);
      for (float& k : kernel) k = static_cast<float>(k / std::pow(spacing, n));
    }
  }
  for (const DerivativeOrder& order : orders) plan.xy_pairs.emplace_back(order[0], order[1]);
  std::sort(plan.xy_pairs.begin(), plan.xy_pairs.end());
  plan.xy_pairs.erase(std::unique(plan.xy_pairs.begin(), plan.xy_pairs.end()), plan.xy_pairs.end());
  for (const DerivativeOrder& order : orders) {
    const auto found =
        std::find(plan.xy_pairs.begin(), plan.xy_pairs.end(), std::pair(order[0], order[1]));
    plan.pair_of_order.push_back(static_cast<std::size_t>(found - plan.xy_pairs.begin()));
  }
  return plan;
}

template <typename T>
void correlate_x(const Plan& plan,
                 const BlockView<T>& input,
                 int z,
                 const Kernel& kernel,
                 float* out) {
  const int nx = plan.geometry.size[0];
  const int radius = radius_of(kernel);
  std::vector<float> padded(plan.nx() + 2 * static_cast<std::size_t>(radius));
  std::vector<const float*> rows(kernel.size());
  for (std::size_t t = 0; t < rows.size(); ++t) rows[t] = padded.data() + t;
  for (int y = 0; y < plan.geometry.size[1]; ++y) {
    const T* row = input.row(y, z);
    std::copy_n(row, plan.nx(), padded.begin() + radius);
    for (int i = 0; i < radius; ++i) {
      padded[static_cast<std::size_t>(i)] = static_cast<float>(row[mirrored(i - radius, nx)]);
      const int right = radius + nx + i;
      padded[static_cast<std::size_t>(right)] = static_cast<float>(row[mirrored(nx + i, nx)]);
    }
    weighted_sum(rows, kernel, out + static_cast<std::size_t>(y) * plan.nx(), plan.nx());
  }
}

void correlate_y(const Plan& plan, const float* slice, const Kernel& kernel, float* out) {
  const int ny = plan.geometry.size[1];
  const int radius = radius_of(kernel);
  std::vector<const float*> rows(kernel.size());
  for (int y = 0; y < ny; ++y) {
    for (int t = 0; t < static_cast<int>(kernel.size()); ++t) {
      rows[static_cast<std::size_t>(t)] =
          slice + static_cast<std::size_t>(mirrored(y + t - radius, ny)) * plan.nx();
    }
    weighted_sum(rows, kernel, out + static_cast<std::size_t>(y) * plan.nx(), plan.nx());
  }
}

const Kernel& kernel_along_z(const Plan& plan, std::size_t order) {
  return plan.kernels[2][static_cast<std::size_t>(plan.orders[order][2])];
}

int z_radius_of(const Plan& plan) {
  int radius = 0;
  for (const Kernel& kernel : plan.kernels[2]) {
    if (!kernel.empty()) radius = std::max(radius, radius_of(kernel));
  }
  return radius;
}

/// The planes that a slice's kernels reach along z, per pair of orders in x and y. A plane goes
/// into the place of the one that is left behind.
template <typename T>
class PlaneRing {
 public:
  PlaneRing(const Plan& plan, const BlockView<T>& input)
      : plan_(plan),
        input_(input),
        count_(2 * z_radius_of(plan) + 1),
        planes_(plan.xy_pairs.size(),
                std::vector<float>(static_cast<std::size_t>(count_) * plan.plane())),
        along_x_(plan.plane()) {}

  /// Brings in slice z, which may lie beyond the volume; it stays until slice z + count does.
  void take(int z) {
    const int source = mirrored(z, plan_.geometry.size[2]);
    int done_order = -1;
    for (std::size_t p = 0; p < plan_.xy_pairs.size(); ++p) {
      const auto [order_x, order_y] = plan_.xy_pairs[p];
      if (order_x != done_order) {
        correlate_x(plan_, input_, source, plan_.kernels[0][static_cast<std::size_t>(order_x)],
                    along_x_.data());
        done_order = order_x;
      }
      correlate_y(plan_, along_x_.data(), plan_.kernels[1][static_cast<std::size_t>(order_y)],
                  planes_[p].data() + place_of(z));
    }
  }
  [[nodiscard]] const float* plane(std::size_t pair, int z) const {
    return planes_[pair].data() + place_of(z);
  }

 private:
  [[nodiscard]] std::size_t place_of(int z) const {
    const int place = (z % count_ + count_) % count_;
    return static_cast<std::size_t>(place) * plan_.plane();
  }

  const Plan& plan_;
  const BlockView<T>& input_;
  int count_;
  std::vector<std::vector<float>> planes_;
  std::vector<float> along_x_;
};

template <typename T>
void filter_slices(const Plan& plan,
                   const BlockView<T>& input,
                   int begin,
                   int end,
                   const CombineRows& combine,
                   std::span<float> output) {
  const int margin = z_radius_of(plan);
  PlaneRing<T> ring(plan, input);
  for (int z = begin - margin; z < begin + margin; ++z) ring.take(z);
  std::vector<std::vector<float>> results(plan.orders.size(), std::vector<float>(plan.nx()));
  std::vector<const float*> result_rows;
  result_rows.reserve(results.size());
  for (const auto& row : results) result_rows.push_back(row.data());
  std::vector<std::vector<const float*>> planes(plan.orders.size());
  std::vector<const float*> rows;
  for (int z = begin; z < end; ++z) {
    ring.take(z + margin);
    for (std::size_t o = 0; o < plan.orders.size(); ++o) {
      const int radius = radius_of(kernel_along_z(plan, o));
      planes[o].clear();
      for (int t = -radius; t <= radius; ++t) {
        planes[o].push_back(ring.plane(plan.pair_of_order[o], z + t));
      }
    }
    for (std::size_t y = 0; y < plan.ny(); ++y) {
      for (std::size_t o = 0; o < plan.orders.size(); ++o) {
        rows = planes[o];
        for (const float*& row : rows) row += y * plan.nx();
        weighted_sum(rows, kernel_along_z(plan, o), results[o].data(), plan.nx());
      }
      combine(result_rows,
              output.data() + static_cast<std::size_t>(z) * plan.plane() + y * plan.nx(),
              plan.nx());
    }
  }
}

}  // namespace

std::vector<float> gaussian_kernel(double sigma, int order) {
  CARPUS_CHECK(sigma >= 0 && order >= 0 && order <= 2);
  if (sigma == 0 && order == 0) return {1.0F};
  // A derivative needs neighbours even where sigma is far below the spacing.
  const double s = std::max(sigma, 0.2);
  const int radius = std::max(1, static_cast<int>(std::ceil(kKernelReach * s)));
  std::vector<double> g;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) sum += g.emplace_back(std::exp(-0.5 * i * i / (s * s)));
  for (double& v : g) v /= sum;
  const auto at = [&](int i) -> double& {
    const int from_start = i + radius;
    return g[static_cast<std::size_t>(from_start)];
  };
  if (order == 1) {
    double slope = 0;
    for (int i = -radius; i <= radius; ++i) slope += (at(i) *= i) * i;
    for (double& v : g) v /= slope;
  } else if (order == 2) {
    double variance = 0;
    for (int i = -radius; i <= radius; ++i) variance += at(i) * i * i;
    double curvature = 0;  // what the kernel answers to i^2 / 2
    for (int i = -radius; i <= radius; ++i) {
      curvature += (at(i) *= i * i - variance) * i * i / 2;
    }
    for (double& v : g) v /= curvature;
  }
  return {g.begin(), g.end()};
}

template <typename T>
void filter_derivatives(const BlockView<T>& input,
                        double sigma_mm,
                        std::span<const DerivativeOrder> orders,
                        const CombineRows& combine,
                        std::span<float> output) {
  CARPUS_CHECK(output.size() == input.geometry().voxel_count());
  if (output.empty()) return;
  const Plan plan = make_plan(input.geometry(), sigma_mm, orders);
  const auto slices = static_cast<std::size_t>(plan.geometry.size[2]);
  parallel_for(slices, kSlices, [&](std::size_t first, std::size_t last) {
    filter_slices(plan, input, static_cast<int>(first), static_cast<int>(last), combine, output);
  });
}

template void filter_derivatives(const BlockView<float>&,
                                 double,
                                 std::span<const DerivativeOrder>,
                                 const CombineRows&,
                                 std::span<float>);
template void filter_derivatives(const BlockView<std::int16_t>&,
                                 double,
                                 std::span<const DerivativeOrder>,
                                 const CombineRows&,
                                 std::span<float>);

}  // namespace carpus::imaging::detail
