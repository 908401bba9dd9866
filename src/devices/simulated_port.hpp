// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A virtual arm on a pseudo-terminal, at true speed: the serial driver opens it as if it were real.
// A hand moves it slowly about and presses down, or does what a calibration asks. Gone, it is
// unplugged.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

#include "devices/guided_hand.hpp"
#include "devices/virtual_unit.hpp"

namespace carpus::devices {

/// Where simulated arms are found by whoever looks for devices: $XDG_RUNTIME_DIR/carpus, or below
/// /tmp, the person's own.
[[nodiscard]] std::filesystem::path simulated_folder();

class SimulatedPort {
 public:
  /// @param folder  in which a link to the terminal stands while it lives. @throws IoError
  SimulatedPort(firmware::Drive drive, std::uint32_t unit, const std::filesystem::path& folder);
  ~SimulatedPort();
  SimulatedPort(const SimulatedPort&) = delete;
  SimulatedPort& operator=(const SimulatedPort&) = delete;

  /// The link: .../arm_b_7
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] ArmCalibration calibration() const { return calibration_; }
  /// From now on the hand does this step of a calibration; past the last it moves by itself.
  void guide(std::size_t step) noexcept { guided_.store(step, std::memory_order_relaxed); }
  [[nodiscard]] const GuidedHand& hand() const noexcept { return hand_; }
  /// Wall clock that the simulation could not keep up with, and gave up [ms].
  [[nodiscard]] long lost_ms() const noexcept { return lost_ms_.load(std::memory_order_relaxed); }

 private:
  void run();

  VirtualUnit unit_;
  ArmCalibration calibration_;
  std::filesystem::path path_;
  int master_ = -1;
  std::atomic<long> lost_ms_{0};
  GuidedHand hand_;
  std::atomic<std::size_t> guided_{static_cast<std::size_t>(-1)};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace carpus::devices
