// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_simulate_command.hpp"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "devices/simulated_port.hpp"

namespace carpus::cli {
namespace {

struct SimulateArguments {
  std::string drive = "B";
  std::uint32_t unit = 1;
  bool uncalibrated = false;
  double seconds = 0;
};

void run(const SimulateArguments& arguments) {
  const bool is_motor = arguments.drive == "B" || arguments.drive == "b";
  if (!is_motor && arguments.drive != "A" && arguments.drive != "a") {
    throw UsageError("device simulate: --drive is A (potentiometer and servo) or B (motor)");
  }
  // Before any thread, so that all of them leave the signals to us.
  sigset_t ends;
  ::sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&ends, signal);
  ::pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  const auto drive = is_motor ? firmware::Drive::Motor : firmware::Drive::Stop;
  const devices::SimulatedPort port(drive, arguments.unit, devices::simulated_folder());
  if (!arguments.uncalibrated) {
    devices::store(port.calibration(), devices::calibration_folder());
  }
  std::printf("a simulated arm (drive %s, unit %u) is at %s; its hand moves by itself\n",
              is_motor ? "B" : "A", arguments.unit, port.path().c_str());
  std::printf("Ctrl+C unplugs it\n");
  std::fflush(stdout);
  if (arguments.seconds > 0) {
    timespec most{};
    most.tv_sec = static_cast<time_t>(arguments.seconds);
    most.tv_nsec = static_cast<long>((arguments.seconds - static_cast<double>(most.tv_sec)) * 1e9);
    (void)::sigtimedwait(&ends, nullptr, &most);
  } else {
    int signal = 0;
    ::sigwait(&ends, &signal);
  }
  std::printf("unplugged; %ld ms were lost to other programs\n", port.lost_ms());
}

}  // namespace

void add_device_simulate_command(CLI::App& device) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = device.add_subcommand(
      "simulate", "Offer a virtual arm on a pseudo-terminal, as if it were plugged in");
  command->add_option("--drive", arguments->drive, "A (potentiometer and servo) or B (motor)")
      ->capture_default_str();
  command->add_option("--unit", arguments->unit, "Its number, which chooses its parts")
      ->capture_default_str();
  command->add_flag("--uncalibrated", arguments->uncalibrated,
                    "Do not store its calibration: for trying 'carpus device calibrate'");
  command->add_option("--seconds", arguments->seconds, "Unplug it after so long; 0: by Ctrl+C")
      ->capture_default_str();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
