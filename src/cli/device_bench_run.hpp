// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What `carpus device bench` does once it is known who runs drive A's firmware: the core compiled
// for the host in `carpus`, the flashed program in simavr in `carpus-arm-bench`, which alone may
// link that (bench/arm).
#pragma once

#include <string>

#include "device_bench/rig.hpp"

namespace CLI {
class App;
}

namespace carpus::cli {

struct DeviceBenchArguments {
  std::string json;
  std::string plot;
  int seeds = 1;
};

void add_device_bench_options(CLI::App& command, DeviceBenchArguments& arguments);

/// @param firmware  who runs drive A's, in words. @param board  its maker; empty: the core here.
/// @throws UsageError, IoError
void run_device_bench(const DeviceBenchArguments& arguments,
                      const std::string& firmware,
                      const device_bench::BoardMaker& board);

}  // namespace carpus::cli
