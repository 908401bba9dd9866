// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/timing.hpp"

#include <algorithm>
#include <cstddef>

namespace carpus::bench {
namespace {

/// Two readings of one time differ by at most a step and what a processor jitters by.
constexpr double kSameTimeSteps = 1.5;

/// The value that a share of the sorted values does not exceed.
double quantile(const std::vector<double>& sorted, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(at, sorted.size() - 1)];
}

double time_of(const std::vector<std::vector<double>>& passes, std::size_t query, double step) {
  double least = passes.front()[query];
  for (const auto& pass : passes) least = std::min(least, pass[query]);
  double sum = 0;
  int count = 0;
  for (const auto& pass : passes) {
    if (pass[query] > least + kSameTimeSteps * step) continue;
    sum += pass[query];
    ++count;
  }
  return sum / count;
}

}  // namespace

Timing timing_of(const std::vector<std::vector<double>>& passes, double step_seconds) {
  Timing timing;
  if (passes.empty() || passes.front().empty()) return timing;
  std::vector<double> times;
  for (std::size_t i = 0; i < passes.front().size(); ++i) {
    times.push_back(time_of(passes, i, step_seconds));
  }
  double sum = 0;
  for (const double s : times) sum += s;
  timing.mean = std::max(0.0, sum / static_cast<double>(times.size()));
  std::sort(times.begin(), times.end());
  const auto share = [&](double of) { return std::max(0.0, quantile(times, of)); };
  timing.median = share(0.5);
  timing.p99 = share(0.99);
  timing.p999 = share(0.999);
  timing.worst = std::max(0.0, times.back());
  timing.queries = times.size();
  std::vector<double> first = passes.front();
  std::sort(first.begin(), first.end());
  timing.p99_one_pass = std::max(0.0, quantile(first, 0.99));
  return timing;
}

}  // namespace carpus::bench
