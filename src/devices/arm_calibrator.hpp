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
/// "notch of 1 dot, 40 degrees up", of the first; counted from 0, over all legs.
[[nodiscard]] std::string notch_in_words(std::size_t step);
/// Samples of one step, a quarter of a second.
inline constexpr std::size_t kSamplesOfStep = 250;
/// Of the step in which drive B's motors turn by themselves, one after another.
inline constexpr std::size_t kSamplesOfAlignment = 7500;
/// Of the step in which a hand leads drive B about: eight seconds.
inline constexpr std::size_t kSamplesOfLead = 8000;
/// Drive A's servos turn by themselves to these pulses, first while a finger lifts the legs to the
/// upper edges of their slots, then while it presses them to the lower ones: left alone they would
/// slide through. The first of each row only comes from
/// afar, but no farther than that a lifted leg keeps from its dead centre, 50 degrees above the
/// horizontal, where leg and rod lie in line.
inline constexpr std::array<int, 6> kSweepUs{1250, 1350, 1425, 1500, 1575, 1650};
inline constexpr std::array<int, 6> kSweepBackUs{1750, 1650, 1575, 1500, 1425, 1350};
/// What the legs turn, and the slot to both sides: a servo must do so much in 0.9 to 2.1 ms.
inline constexpr double kServoTravelDeg = 154;
/// Counts between least and most of them: more is a hand that moves, or a loose wiper.
inline constexpr int kMostSpreadStop = 24;
inline constexpr int kMostSpreadMotor = 60;

class ArmCalibrator {
 public:
  /// @param known  what was known of this unit.
  ArmCalibrator(firmware::Drive drive,
                std::uint32_t unit,
                std::optional<ArmCalibration> known = std::nullopt);

  [[nodiscard]] std::size_t step() const noexcept { return step_; }
  [[nodiscard]] std::size_t step_count() const noexcept;
  [[nodiscard]] bool is_complete() const noexcept { return step_ == step_count(); }
  /// All that must be measured is; drive B may then be led about, so that its motors' cogging is
  /// taken off, and if it is not, what was known of that stays.
  [[nodiscard]] bool is_whole() const noexcept;
  /// The arm does this step by itself: its servos turn to pulse_us(), and after settle_ms() there
  /// is something to measure; of drive B, at any pulse, its motors look for their windings. 0: they
  /// do not.
  [[nodiscard]] int pulse_us() const noexcept;
  [[nodiscard]] bool is_by_itself() const noexcept;
  [[nodiscard]] int settle_ms() const noexcept;
  /// How many samples this step takes, one a millisecond.
  [[nodiscard]] std::size_t sample_count() const noexcept;
  /// Whether this step's samples are together, or what it waits for has come.
  [[nodiscard]] bool is_enough(std::size_t samples, const MotorWindings& windings) const noexcept;
  /// What the person is to do now.
  [[nodiscard]] std::string instruction() const;
  /// @param samples  of the three sensors while the person keeps still. @param windings  what drive
  /// B said last of them.
  /// @return what was wrong with them, and step() is to be done again: the same, or where a leg's
  /// points do not fit each other its first; none: on to the next.
  [[nodiscard]] std::optional<std::string> take(
      const std::vector<std::array<std::int32_t, kLegs>>& samples,
      const MotorWindings& windings = {});
  /// Once it is whole. A refusal says which leg's servo sits wrong, and the servos' steps begin
  /// anew.
  [[nodiscard]] Result<ArmCalibration> finish(std::string made_at);

 private:
  [[nodiscard]] std::optional<std::string> take_lead(
      const std::vector<std::array<std::int32_t, kLegs>>& samples);
  [[nodiscard]] std::optional<std::string> take_windings(const MotorWindings& windings);
  [[nodiscard]] std::optional<std::string> fit_leg(std::size_t leg);
  [[nodiscard]] std::optional<std::string> fit_servo(std::size_t leg);

  ArmCalibration made_;
  std::size_t step_ = 0;
  std::array<std::vector<arm::CalibrationPoint>, kLegs> points_;
  /// Counts at each pulse of both sweeps.
  std::array<std::array<double, kSweepUs.size() + kSweepBackUs.size()>, kLegs> swept_{};
};

}  // namespace carpus::devices
