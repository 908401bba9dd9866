// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is known of one arm: of its sensors, of its servos, and how it is kept, one file a unit.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "arm/cogging.hpp"
#include "arm/leg_calibration.hpp"
#include "firmware/core/gimbal_commutation.hpp"
#include "firmware/core/wire.hpp"

namespace carpus::devices {

inline constexpr std::size_t kLegs = 3;

/// Drive A: how the horn of a leg's servo sits. As it stands: a servo of 270 degrees in 2 ms, as
/// the parts list asks for, put on with the slot 10 degrees below the horizontal.
struct ServoFit {
  double pulse_at_zero_us = 1426;  ///< puts the slot around the leg at angle 0
  double pulse_per_half_turn_us = 1333;
  double gap_rad = 0.157;  ///< from the middle of the slot to its edge: 9 degrees
  double least_pulse_us = 900;
  double most_pulse_us = 2100;
};

struct ArmCalibration {
  firmware::Drive drive = firmware::Drive::Stop;
  std::uint32_t unit = 0;
  /// Drive A.
  std::array<arm::LegCalibration, kLegs> legs;
  std::array<ServoFit, kLegs> servos;
  /// Drive B: the encoders' counts of one turn of the motor where the leg is at angle 0.
  std::array<std::int32_t, kLegs> zero_in_turn{};
  std::array<firmware::WindingsOf, kLegs> windings;  ///< how they stand to the encoders
  arm::Cogging cogging;       ///< of its motors; none where that was not measured
  std::string made_at = "-";  ///< UTC
};

/// Of a turn of a motor of drive B, of which ten are one of the leg.
inline constexpr std::int32_t kCountsOfTurn = 16384;
inline constexpr double kRadPerMotorCount = 6.283185307179586 / (kCountsOfTurn * 10.0);

/// How the legs stand when the arm lies in its cradle, the tip in the middle of its workspace.
/// There drive B is switched on, within half a turn of a motor, 18 degrees of a leg: so its turns
/// are told from each other.
[[nodiscard]] double cradle_angle_rad() noexcept;

/// Counts at angle 0, of a leg that rests now.
[[nodiscard]] std::int32_t home_of(std::int32_t zero_in_turn, std::int32_t counts_at_rest) noexcept;

/// $XDG_CONFIG_HOME/carpus/devices, or below ~/.config.
[[nodiscard]] std::filesystem::path calibration_folder();
[[nodiscard]] std::string calibration_file_name(firmware::Drive drive, std::uint32_t unit);

/// Whole, or as it was before. @throws IoError
void store(const ArmCalibration& calibration, const std::filesystem::path& folder);
/// @throws InvalidInput where it is no calibration, with file and field.
[[nodiscard]] ArmCalibration parse_calibration(std::string_view text, std::string_view file);
/// All of the folder; those that cannot be read are left out and told in `problems`.
[[nodiscard]] std::vector<ArmCalibration> load_calibrations(const std::filesystem::path& folder,
                                                            std::vector<std::string>& problems);

}  // namespace carpus::devices
