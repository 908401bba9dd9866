// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/provenance.hpp"

#include <fstream>
#include <thread>

#include "commit.hpp"  // written by the build

namespace carpus::bench {

Provenance provenance() {
  Provenance p;
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0) {
      p.machine = line.substr(line.find(':') + 2);
      break;
    }
  }
  p.machine += ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
#ifdef __clang__
  p.compiler = __VERSION__;
#else
  p.compiler = std::string("g++ ") + __VERSION__;
#endif
  p.flags = CARPUS_BENCH_FLAGS;
  p.commit = CARPUS_BENCH_COMMIT;
  return p;
}

}  // namespace carpus::bench
