// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A guided calibration beside a loop that runs, for whoever cannot wait: asked now and then.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "devices/arm_calibrator.hpp"
#include "devices/host_loop.hpp"

namespace carpus::devices {

class CalibrationDesk {
 public:
  /// @throws InvalidInput where the device is none that is calibrated by us.
  CalibrationDesk(HostLoop& loop, const LoopState& state, std::filesystem::path folder);

  /// What it let turn stands still again, and the arm takes what was stored.
  ~CalibrationDesk();
  CalibrationDesk(const CalibrationDesk&) = delete;
  CalibrationDesk& operator=(const CalibrationDesk&) = delete;

  /// Measures what is held now, over the next quarter of a second, or as long as the step takes.
  void take();
  /// To be called several times a second. @return true once all is stored: the desk is of no use
  /// any more.
  [[nodiscard]] bool look(const std::string& now_utc, const LoopState& state);
  [[nodiscard]] std::string instruction() const;
  /// What must be measured is stored; what is left may be left out.
  [[nodiscard]] bool is_stored() const noexcept { return is_stored_; }
  /// What came of the last step.
  [[nodiscard]] const std::string& note() const noexcept { return note_; }

 private:
  HostLoop& loop_;
  std::filesystem::path folder_;
  ArmCalibrator calibrator_;
  std::string note_;
  bool is_measuring_ = false;
  bool is_stored_ = false;
  std::chrono::milliseconds settles_{0};
  std::chrono::steady_clock::time_point began_;
  std::vector<std::array<std::int32_t, kLegs>> samples_;
};

}  // namespace carpus::devices
