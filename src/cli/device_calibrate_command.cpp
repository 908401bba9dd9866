// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_calibrate_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/device_choice.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "devices/arm_calibrator.hpp"
#include "records/utc_time.hpp"

namespace carpus::cli {
namespace {

using devices::LoopState;

struct CalibrateArguments {
  std::string device;
  bool evens_motors = false;
};

/// What the sensors say for this step, once the servos, where they turn, have come there.
std::vector<std::array<std::int32_t, devices::kLegs>>
listen(devices::HostLoop& loop, const devices::ArmCalibrator& calibrator, LoopState& state) {
  std::vector<std::array<std::int32_t, devices::kLegs>> samples;
  loop.turn_servos(calibrator.pulse_us());
  std::this_thread::sleep_for(std::chrono::milliseconds(calibrator.settle_ms()));
  while (loop.next_raw()) {
  }
  const std::size_t wanted = calibrator.sample_count();
  const auto until =
      std::chrono::steady_clock::now() + std::chrono::milliseconds(1000 + 2 * wanted);
  while (!calibrator.is_enough(samples.size(), state.device.windings) &&
         std::chrono::steady_clock::now() < until) {
    while (const auto sample = loop.next_raw()) samples.push_back(*sample);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    (void)loop.look(state);
  }
  return samples;
}

void wait_for_enter(const std::string& what) {
  std::printf("%s Then press Enter. ", what.c_str());
  std::fflush(stdout);
  if (std::string line; !std::getline(std::cin, line)) {
    throw InvalidInput("the calibration was given up; what was known before stays");
  }
}

std::optional<devices::ArmCalibration> known(const devices::DeviceSearch& search,
                                             firmware::Drive drive,
                                             std::uint32_t unit) {
  std::vector<std::string> problems;
  for (auto& one : devices::load_calibrations(search.calibrations, problems)) {
    if (one.drive == drive && one.unit == unit) return one;
  }
  return std::nullopt;
}

void run(const CalibrateArguments& arguments) {
  const devices::DeviceSearch search = devices::search_here();
  const std::string id = choose_device(arguments.device, search);
  if (!id.starts_with("arm:")) {
    throw InvalidInput(id + " needs no calibration of ours; 'carpus device test' tries it");
  }
  devices::HostLoop loop(devices::make_device(id, search));
  LoopState state;
  if (!wait_until(loop, state, kStartSeconds,
                  [](const LoopState& now) { return now.device.raw_samples > 0; })) {
    throw IoError(id + ": " + health_in_words(loop, state));
  }
  const firmware::Drive drive = state.able.stop ? firmware::Drive::Stop : firmware::Drive::Motor;
  if (arguments.evens_motors && drive == firmware::Drive::Stop) {
    throw UsageError("device calibrate: --even-motors is for drive B, and this is drive A");
  }
  std::printf("%s: drive %s, unit %u\n", id.c_str(), state.able.stop ? "A" : "B",
              state.device.unit);
  devices::ArmCalibrator calibrator(drive, state.device.unit,
                                    known(search, drive, state.device.unit));
  const auto is_done = [&] {
    return arguments.evens_motors ? calibrator.is_complete() : calibrator.is_whole();
  };
  const std::size_t steps = calibrator.step_count() -
                            (drive == firmware::Drive::Motor && !arguments.evens_motors ? 1 : 0);
  std::optional<devices::ArmCalibration> made;
  while (!made) {
    while (!is_done()) {
      if (!calibrator.is_by_itself()) {
        loop.turn_servos(0);
        wait_for_enter("[" + std::to_string(calibrator.step() + 1) + "/" + std::to_string(steps) +
                       "] " + calibrator.instruction());
      }
      std::printf("  measuring ...\n");
      std::fflush(stdout);
      const auto samples = listen(loop, calibrator, state);
      if (const auto problem = calibrator.take(samples, state.device.windings)) {
        std::printf("  %s\n", problem->c_str());
        // Or servos would be asked to turn for ever, of an arm that is gone.
        (void)loop.look(state);
        if (state.device.health == devices::Health::Gone ||
            state.device.health == devices::Health::Silent) {
          throw IoError(id + ": " + health_in_words(loop, state) +
                        "; the calibration was given up, what was known before stays");
        }
      }
    }
    const Result<devices::ArmCalibration> result = calibrator.finish(records::utc_now());
    if (result) {
      made = *result;
    } else {
      std::printf("%s\n", result.error().c_str());
    }
  }
  loop.turn_servos(0);
  devices::store(*made, search.calibrations);
  if (drive == firmware::Drive::Stop) {
    for (std::size_t leg = 0; leg < devices::kLegs; ++leg) {
      std::printf("leg %zu: a straight line would be up to %.1f degrees off; that is taken off\n",
                  leg + 1, degrees_from_radians(made->legs[leg].line_error_rad));
    }
  }
  loop.reopen();
  wait_until(loop, state, kStartSeconds,
             [](const LoopState& now) { return devices::is_usable(now.device.health); });
  std::printf("stored in %s; the arm is now: %s\n",
              (search.calibrations / devices::calibration_file_name(drive, made->unit)).c_str(),
              health_in_words(loop, state).c_str());
}

}  // namespace

void add_device_calibrate_command(CLI::App& device) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = device.add_subcommand("calibrate", "Calibrate an arm, guided step by step");
  command->add_option("--device", arguments->device,
                      "Id as 'list' shows it; the only one if left out");
  command->add_flag("--even-motors", arguments->evens_motors,
                    "Drive B: also measure its motors' cogging, while a hand leads it about");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace carpus::cli
