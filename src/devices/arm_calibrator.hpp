// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The guided calibration of an arm, step by step, the same for terminal and page: what the person
// is to do, what the sensors said meanwhile, and what comes of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "devices/arm_calibration.hpp"
#include "devices/device.hpp"

namespace carpus::devices {

/// The gauge's notches, at which a leg of drive A is held [degrees below the horizontal].
inline constexpr std::array<double, 6> kGaugeDeg{-40, -20, 0, 20, 40, 60};
/// Samples of one step, a quarter of a second.
inline constexpr std::size_t kSamplesOfStep = 250;
/// Counts between least and most of them: more is a hand that moves, or a loose wiper.
inline constexpr int kMostSpreadStop = 24;
inline constexpr int kMostSpreadMotor = 60;

class ArmCalibrator {
 public:
  /// @param known  what was known of this unit; its servos' fit is kept.
  ArmCalibrator(firmware::Drive drive,
                std::uint32_t unit,
                std::optional<ArmCalibration> known = std::nullopt);

  [[nodiscard]] std::size_t step() const noexcept { return step_; }
  [[nodiscard]] std::size_t step_count() const noexcept;
  [[nodiscard]] bool is_complete() const noexcept { return step_ == step_count(); }
  /// What the person is to do now.
  [[nodiscard]] std::string instruction() const;
  /// @param samples  of the three sensors while the person keeps still.
  /// @return what was wrong with them, and the step is to be done again; none: on to the next.
  [[nodiscard]] std::optional<std::string> take(
      const std::vector<std::array<std::int32_t, kLegs>>& samples);
  /// Of all steps. A refusal says which leg, and the steps begin anew.
  [[nodiscard]] Result<ArmCalibration> finish(std::string made_at);

 private:
  ArmCalibration made_;
  std::size_t step_ = 0;
  std::array<std::vector<arm::CalibrationPoint>, kLegs> points_;
};

}  // namespace carpus::devices
