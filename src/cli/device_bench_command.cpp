// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_bench_command.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/child_program.hpp"
#include "cli/device_bench_run.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

struct Arguments {
  DeviceBenchArguments bench;
  std::string firmware = "auto";
};

/// The program that may link simavr, where it was built.
std::filesystem::path simavr_program() { return own_program().parent_path() / "carpus-arm-bench"; }

/// Becomes carpus-arm-bench; returns only by an exception.
void become(const std::filesystem::path& program, const DeviceBenchArguments& bench) {
  std::vector<std::string> words{program.string(), "--seeds", std::to_string(bench.seeds)};
  if (!bench.json.empty()) words.insert(words.end(), {"--json", bench.json});
  if (!bench.plot.empty()) words.insert(words.end(), {"--plot", bench.plot});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::fflush(stdout);
  ::execv(program.c_str(), argv.data());
  throw IoError(program.string() + ": cannot be started");
}

void run(const Arguments& arguments) {
  if (arguments.firmware != "auto" && arguments.firmware != "simavr" &&
      arguments.firmware != "core") {
    throw UsageError("device bench: --firmware is auto, simavr or core");
  }
  const std::filesystem::path program = simavr_program();
  const bool is_there = std::filesystem::exists(program);
  if (arguments.firmware == "simavr" && !is_there) {
    throw IoError(program.string() +
                  ": not there. It is built where avr-g++ and simavr are installed: run "
                  "tools/install test, then configure and build again.");
  }
  if (is_there && arguments.firmware != "core") become(program, arguments.bench);
  if (!is_there) {
    std::fprintf(stderr,
                 "drive A's flashed program in simavr is left out: carpus-arm-bench is not beside "
                 "this program (tools/install test, then build again); its core runs instead\n");
  }
  run_device_bench(arguments.bench, "core compiled for the host", {});
}

}  // namespace

void add_device_bench_command(CLI::App& device) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = device.add_subcommand(
      "bench", "Measure both drives and the thesis's arm, with simulated hands, in virtual time");
  add_device_bench_options(*command, arguments->bench);
  command
      ->add_option("--firmware", arguments->firmware,
                   "Drive A's: simavr (the flashed program), core (compiled for the host), or auto")
      ->capture_default_str();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
