// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/fluoroscopy/speed.hpp"

#include <algorithm>
#include <ctime>
#include <vector>

namespace carpus::bench {
namespace {

double now(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

PictureTimes time_pictures(const std::string& what,
                           int pixels,
                           double budget_seconds,
                           const std::function<void(int)>& take) {
  constexpr int kFewest = 5;
  take(0);
  std::vector<double> seconds;
  const double processor = now(CLOCK_PROCESS_CPUTIME_ID);
  const double start = now(CLOCK_MONOTONIC);
  for (int i = 1; i <= kFewest || now(CLOCK_MONOTONIC) - start < budget_seconds; ++i) {
    const double before = now(CLOCK_MONOTONIC);
    take(i);
    seconds.push_back(now(CLOCK_MONOTONIC) - before);
  }
  PictureTimes times{what, pixels, 0, 0, 0, static_cast<int>(seconds.size())};
  times.processor_seconds =
      (now(CLOCK_PROCESS_CPUTIME_ID) - processor) / static_cast<double>(seconds.size());
  std::sort(seconds.begin(), seconds.end());
  times.seconds = seconds[seconds.size() / 2];
  times.worst_seconds = seconds.back();
  return times;
}

}  // namespace carpus::bench
