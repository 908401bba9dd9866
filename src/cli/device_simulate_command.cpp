// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_simulate_command.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
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

/// The hand of a calibration goes on by Enter, until one of the signals or the time ends it.
void guide(devices::SimulatedPort& port, const sigset_t& ends, double seconds, bool is_guided) {
  const int signals = ::signalfd(-1, &ends, SFD_CLOEXEC);
  if (signals < 0) throw IoError("signals cannot be waited for");
  const std::size_t steps = port.hand().step_count();
  std::size_t step = is_guided ? 0 : steps;
  const auto tell = [&] {
    port.guide(step);
    std::printf("  its hand %s%s\n", port.hand().in_words(step).c_str(),
                step < steps ? ". Enter: next; b and Enter: back" : "");
    std::fflush(stdout);
  };
  if (is_guided) tell();
  bool goes_back = false;
  pollfd waits[2] = {{signals, POLLIN, 0}, {is_guided ? STDIN_FILENO : -1, POLLIN, 0}};
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    const std::chrono::duration<double, std::milli> left = until - std::chrono::steady_clock::now();
    if (seconds > 0 && left.count() <= 0) break;
    const int changed =
        ::poll(waits, 2, seconds > 0 ? static_cast<int>(std::min(left.count(), 1e6)) + 1 : -1);
    if (changed > 0 && waits[0].revents != 0) break;
    if (changed <= 0 || waits[1].revents == 0) continue;
    char typed[256];
    const ssize_t count = ::read(STDIN_FILENO, typed, sizeof typed);
    if (count <= 0) waits[1].fd = -1;  // nobody types: the step stays
    for (ssize_t i = 0; i < count; ++i) {
      if (typed[i] == 'b') goes_back = true;
      if (typed[i] != '\n') continue;
      if (goes_back ? step > 0 : step < steps) {
        step = goes_back ? step - 1 : step + 1;
        tell();
      }
      goes_back = false;
    }
  }
  ::close(signals);
}

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
  devices::SimulatedPort port(drive, arguments.unit, devices::simulated_folder());
  if (!arguments.uncalibrated) {
    devices::store(port.calibration(), devices::calibration_folder());
  }
  const bool is_guided = arguments.uncalibrated;
  std::printf("a simulated arm (drive %s, unit %u) is at %s; %s\nCtrl+C unplugs it\n",
              is_motor ? "B" : "A", arguments.unit, port.path().c_str(),
              is_guided ? "its hand does what a calibration asks, here before there"
                        : "its hand moves by itself");
  std::fflush(stdout);
  guide(port, ends, arguments.seconds, is_guided);
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
