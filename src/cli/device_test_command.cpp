// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_test_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "cli/device_choice.hpp"
#include "cli/output_file.hpp"
#include "core/error.hpp"
#include "records/atomic_file.hpp"

namespace carpus::cli {
namespace {

using devices::DeviceCommand;
using devices::LoopState;

struct TestArguments {
  std::string device;
  double seconds = 10;
  double wall_mm = 5;
  double stiffness = 1;
  double limit = 3;
  std::string json;
};

/// Of the last minute, all processors: 1 is one that has always something to do.
double load_of_machine() {
  std::ifstream file("/proc/loadavg");
  double load = 0;
  file >> load;
  return load;
}

/// Level, some way below where the tip is now.
DeviceCommand wall_below(const TestArguments& arguments, const LoopState& now) {
  DeviceCommand wall;
  wall.plane_count = 1;
  wall.planes[0] = {{0, 0, 1},
                    now.device.position_mm.z - arguments.wall_mm,
                    arguments.stiffness,
                    0.002 * arguments.stiffness,
                    0.2};
  wall.limit_n = arguments.limit;
  return wall;
}

struct Measured {
  devices::LoopTiming last;
  double late_p50_us = 0;
  double late_p99_us = 0;
  double late_p999_us = 0;
  double late_worst_us = 0;
  double deepest_mm = 0;
  double strongest_n = 0;
  double unwell_s = 0;
};

/// A wall that stands knows not how it is pressed.
std::string force_in_words(const LoopState& state) {
  if (!state.able.force) return "force not measured";
  char words[32];
  std::snprintf(words, sizeof words, "force %4.1f N", length(state.device.force_n));
  return words;
}

/// Feels the wall for so long, and prints a line a second.
Measured feel(devices::HostLoop& loop, LoopState& state, const TestArguments& arguments) {
  const bool has_places = state.able.absolute && state.able.position;
  const DeviceCommand wall = has_places ? wall_below(arguments, state) : DeviceCommand{};
  if (has_places) {
    std::printf("a wall of %.1f N/mm is %.0f mm below the tip: press on it, slide along it\n",
                arguments.stiffness, arguments.wall_mm);
  }
  Measured measured;
  const auto begin = std::chrono::steady_clock::now();
  int told = 0;
  double unwell_ms = 0;
  while (true) {
    const double passed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (passed > arguments.seconds) break;
    (void)loop.look(state);
    loop.wish({wall, devices::monotonic_now()});
    if (!devices::is_usable(state.device.health)) unwell_ms += 1;
    if (has_places) {
      const double depth = wall.planes[0].offset_mm - state.device.position_mm.z;
      measured.deepest_mm = std::max(measured.deepest_mm, depth);
    }
    measured.strongest_n = std::max(measured.strongest_n, length(state.device.force_n));
    const devices::LoopTiming& timing = state.timing;
    measured.last = timing;
    measured.late_p50_us = std::max(measured.late_p50_us, timing.late_p50_us);
    measured.late_p99_us = std::max(measured.late_p99_us, timing.late_p99_us);
    measured.late_p999_us = std::max(measured.late_p999_us, timing.late_p999_us);
    measured.late_worst_us = std::max(measured.late_worst_us, timing.late_worst_us);
    if (static_cast<int>(passed) > told) {
      told = static_cast<int>(passed);
      const devices::DeviceState& device = state.device;
      std::printf("%3d s  %-14s  at %6.1f %6.1f %6.1f mm  %s  %4.0f Hz  %llu missed\n", told,
                  devices::in_words(device.health), device.position_mm.x, device.position_mm.y,
                  device.position_mm.z, force_in_words(state).c_str(), timing.rate_hz,
                  static_cast<unsigned long long>(timing.missed));
      std::fflush(stdout);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  measured.unwell_s = unwell_ms / 1000;
  return measured;
}

nlohmann::ordered_json figures_of(const std::string& id,
                                  const LoopState& state,
                                  const Measured& measured) {
  const devices::LoopTiming& timing = measured.last;
  return {
      {"device", id},
      {"health", devices::in_words(state.device.health)},
      {"can", devices::in_words(state.able)},
      {"class", timing.scheduling == devices::SchedulingClass::Fifo ? "SCHED_FIFO" : "SCHED_OTHER"},
      {"memory_locked", timing.memory_locked},
      {"fine_timer", timing.fine_timer},
      {"load", load_of_machine()},
      {"processors", std::thread::hardware_concurrency()},
      {"rate_hz", timing.rate_hz},
      {"late_p50_us", measured.late_p50_us},
      {"late_p99_us", measured.late_p99_us},
      {"late_p999_us", measured.late_p999_us},
      {"late_worst_us", measured.late_worst_us},
      {"ticks", timing.ticks},
      {"missed", timing.missed},
      {"work_share", timing.work_share},
      {"round_trip_p50_us", timing.round_trip_p50_us},
      {"round_trip_p99_us", timing.round_trip_p99_us},
      {"refused", state.device.refused},
      {"unsent", state.device.unsent},
      {"faults", state.faults},
      {"strongest_n", state.able.force ? nlohmann::ordered_json(measured.strongest_n)
                                       : nlohmann::ordered_json(nullptr)},
      {"deepest_mm", measured.deepest_mm},
      {"unwell_s", measured.unwell_s}};
}

void print(const nlohmann::ordered_json& f) {
  const auto number = [&f](const char* name) { return f[name].get<double>(); };
  std::printf("loop: %.1f Hz, %s, %s, timer %s; load of the machine %.2f on %d processors\n",
              number("rate_hz"), f["class"].get<std::string>().c_str(),
              f["memory_locked"].get<bool>() ? "memory locked" : "memory not locked",
              f["fine_timer"].get<bool>() ? "fine" : "with slack", number("load"),
              f["processors"].get<int>());
  std::printf(
      "late: p50 %.1f us, p99 %.1f us, p99.9 %.1f us, worst %.0f us (worst second of each); "
      "%llu of %llu ticks missed\n",
      number("late_p50_us"), number("late_p99_us"), number("late_p999_us"), number("late_worst_us"),
      f["missed"].get<unsigned long long>(), f["ticks"].get<unsigned long long>());
  std::printf("work: %.1f %% of each tick; round trip p50 %.0f us, p99 %.0f us\n",
              100 * number("work_share"), number("round_trip_p50_us"), number("round_trip_p99_us"));
  if (f["strongest_n"].is_null()) {
    std::printf("felt: a wall that stands, its force not measured; ");
  } else {
    std::printf("felt: up to %.2f N; ", number("strongest_n"));
  }
  std::printf("%.2f mm into the wall; %llu refused, %llu unsent\n", number("deepest_mm"),
              f["refused"].get<unsigned long long>(), f["unsent"].get<unsigned long long>());
}

void run(const TestArguments& arguments) {
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  if (!within(arguments.seconds, 1.5, 3600) || !within(arguments.stiffness, 0.05, 5) ||
      !within(arguments.limit, 0, 8) || !within(arguments.wall_mm, 0, 60)) {
    throw UsageError(
        "device test: --seconds 1.5 to 3600, --wall-n-per-mm 0.05 to 5, --wall-mm 0 to 60, "
        "--force-limit-n 0 to 8");
  }
  const devices::DeviceSearch search = devices::search_here();
  const std::string id = choose_device(arguments.device, search);
  devices::HostLoop loop(devices::make_device(id, search));
  LoopState state;
  const bool is_well = wait_until(loop, state, kStartSeconds, [](const LoopState& now) {
    return devices::is_usable(now.device.health);
  });
  std::printf("%s: %s\n", id.c_str(), health_in_words(loop, state).c_str());
  if (!is_well) throw IoError(id + " cannot be felt as it is now");
  const Measured measured = feel(loop, state, arguments);
  const nlohmann::ordered_json figures = figures_of(id, state, measured);
  print(figures);
  if (!arguments.json.empty()) {
    records::write_file_atomically(arguments.json, figures.dump(2) + "\n");
  }
}

}  // namespace

void add_device_test_command(CLI::App& device) {
  auto arguments = std::make_shared<TestArguments>();
  CLI::App* command =
      device.add_subcommand("test", "Feel a test wall, and measure how well time is kept");
  command->add_option("--device", arguments->device,
                      "Id as 'list' shows it; the only one if left out");
  command->add_option("--seconds", arguments->seconds, "How long [s]")->capture_default_str();
  command->add_option("--wall-mm", arguments->wall_mm, "So far below the tip is the wall [mm]")
      ->capture_default_str();
  command->add_option("--wall-n-per-mm", arguments->stiffness, "Stiffness of the wall [N/mm]")
      ->capture_default_str();
  command->add_option("--force-limit-n", arguments->limit, "Never more than this [N]")
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the figures to this file")
      ->check(output_file());
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
