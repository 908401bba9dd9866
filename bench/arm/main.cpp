// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// carpus-arm-bench: `carpus device bench` with drive A's flashed program in simavr. A program of
// its own, not installed, because simavr is GPL.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "bench/arm/avr_board.hpp"
#include "cli/device_bench_run.hpp"
#include "core/error.hpp"

int main(int argc, char** argv) {
  CLI::App app{"carpus-arm-bench: the force-feedback arm measured in virtual time"};
  carpus::cli::DeviceBenchArguments arguments;
  carpus::cli::add_device_bench_options(app, arguments);
  try {
    app.parse(argc, argv);
    carpus::cli::run_device_bench(arguments, "its flashed program on an ATmega328P in simavr", [] {
      return std::make_unique<carpus::bench::AvrBoard>(CARPUS_ARM_AVR_ELF);
    });
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const carpus::UsageError& error) {
    std::fprintf(stderr, "carpus-arm-bench: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "carpus-arm-bench: %s\n", error.what());
    return 1;
  }
}
