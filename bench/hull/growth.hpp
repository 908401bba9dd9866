// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How time grows: fitted over all sizes, and from each size to the next.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bench/hull/hull_bench.hpp"

namespace carpus::bench {

struct GrowthSample {
  double count = 0;
  double seconds = 0;
};

/// Slope of log(seconds) over log(count), by least squares. Needs two counts that differ.
[[nodiscard]] double exponent_of(const std::vector<GrowthSample>& samples);

/// What exponent_of gives for n log n at the same counts: above 1, as the logarithm grows too.
[[nodiscard]] double n_log_n_exponent(const std::vector<GrowthSample>& samples);

/// One engine on one distribution of three sizes or more.
struct Growth {
  std::string set;
  std::string engine;
  std::vector<GrowthSample> samples;  ///< ascending
  /// From each sample to the next: where caches overflow, one is larger than the others.
  [[nodiscard]] std::vector<double> steps() const;
};

[[nodiscard]] std::vector<Growth> growth_with_points(const std::vector<HullRow>& rows);

/// Corners of the exact hull of each set and number of points: an engine that misses corners does
/// not move its own point of a curve.
class ExactCorners {
 public:
  explicit ExactCorners(const std::vector<HullRow>& rows);
  /// 0 where no engine gave the exact answer.
  [[nodiscard]] std::size_t of(const HullRow& row) const;

 private:
  std::map<std::pair<std::string, std::size_t>, std::size_t> corners_;
};

/// Growth with n for each distribution and engine, with h for each engine and n over three
/// distributions or more.
[[nodiscard]] std::string growth_text(const std::vector<HullRow>& rows);

/// What brute force would take for `whole` points, from the rows of fewer that it ran on.
[[nodiscard]] std::string brute_force_growth_of(const std::vector<HullRow>& rows,
                                                std::size_t whole);

}  // namespace carpus::bench
