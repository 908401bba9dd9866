// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What many timed queries of one engine come to.
#pragma once

#include <cstdint>
#include <vector>

namespace carpus::bench {

/// Crosses a pipe by its bytes.
struct Timing {
  double median = 0;  ///< seconds
  double p99 = 0;
  double p999 = 0;
  double worst = 0;
  double mean = 0;
  double p99_one_pass = 0;  ///< of the first pass alone, what else the machine did included
  std::uint64_t queries = 0;
  std::uint64_t wrong = 0;       ///< verdicts, beyond touching up to rounding
  std::uint64_t wrong_near = 0;  ///< verdicts where the bodies touch up to rounding
  std::uint64_t unknown = 0;
  double largest_error_mm = 0;  ///< of distances or depths, against the oracle
  std::uint64_t missing = 0;    ///< distances or depths that were not given
};

/// A query's time is what its fastest pass took, as nearly as a clock tells that advances in steps:
/// such a clock reads a time now a step too low, now too high, so that the least reading is too
/// low. The mean of all readings that may be the same time is not.
/// @param passes  [p][i]: seconds of query i in pass p; below zero where the cost of reading the
///     clock was more than what it read.
/// @param step_seconds  of the clock; 0: the least reading counts.
[[nodiscard]] Timing timing_of(const std::vector<std::vector<double>>& passes,
                               double step_seconds = 0);

}  // namespace carpus::bench
