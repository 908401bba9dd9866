// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Time of the calling thread on a processor. Every engine here runs on one thread, and what other
// programs take from it meanwhile is not its cost.
#pragma once

#include <ctime>

namespace carpus::bench {

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return now() - start_; }

 private:
  [[nodiscard]] static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

}  // namespace carpus::bench
