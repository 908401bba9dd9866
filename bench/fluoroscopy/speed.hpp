// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How many pictures a second.
#pragma once

#include <functional>
#include <string>

namespace carpus::bench {

struct PictureTimes {
  std::string what;
  int pixels = 0;
  double seconds = 0.0;  ///< median of wall time, on all cores
  double worst_seconds = 0.0;
  double processor_seconds = 0.0;  ///< of all threads, mean
  int pictures = 0;                ///< that were measured
};

/// Takes pictures 0, 1, ... for about `budget_seconds` after one that is not counted.
[[nodiscard]] PictureTimes time_pictures(const std::string& what,
                                         int pixels,
                                         double budget_seconds,
                                         const std::function<void(int)>& take);

}  // namespace carpus::bench
