// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart/spread_labels.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace carpus::bench {

// Less i * spacing each, the places only have to be ascending: isotonic regression, by pooling
// neighbours that are out of order at their mean.
std::vector<double> spread_labels(const std::vector<double>& wanted,
                                  double spacing,
                                  double low,
                                  double high) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  struct Pool {
    double sum = 0;
    double count = 0;
    [[nodiscard]] double mean() const { return sum / count; }
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < order.size(); ++i) {
    pools.push_back({wanted[order[i]] - spacing * static_cast<double>(i), 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  const double room = high - spacing * (static_cast<double>(wanted.size()) - 1);
  std::vector<double> places(wanted.size());
  std::size_t i = 0;
  for (const Pool& pool : pools) {
    for (double k = 0; k < pool.count; ++k, ++i) {
      const double start = std::max(low, std::min(pool.mean(), room));
      places[order[i]] = start + spacing * static_cast<double>(i);
    }
  }
  return places;
}

}  // namespace carpus::bench
