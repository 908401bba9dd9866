// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an operator does in one tick: the only way anything reaches the simulation, from whatever
// device, script or recording.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "geometry/vec3.hpp"

namespace carpus::simulation {

/// The powered driver that holds the guide wire, or the screw driver once a screw is loaded.
enum class Driver : std::uint8_t { Off = 0, Forward = 1, Reverse = 2 };

/// Things done once rather than held.
enum class CommandKind : std::uint8_t {
  None = 0,
  TakeShot = 1,     ///< one fluoroscopy image; `rotation_deg`, `tilt_deg` say from where
  Measure = 2,      ///< read the depth gauge at the guide wire
  SelectScrew = 3,  ///< load the screw `index` of the catalogue on the driver
  Undo = 4,         ///< back to the last checkpoint; counted, time and shots stay spent
  Finish = 5,       ///< end the operation
};

struct Command {
  CommandKind kind = CommandKind::None;
  std::int32_t index = 0;  ///< SelectScrew: position in the catalogue
  double rotation_deg =
      0.0;  ///< TakeShot: as fluoroscopy/c_arm.hpp: 0 = PA, 90 = lateral, 45 = pronated oblique
  double tilt_deg = 0.0;  ///< TakeShot: towards proximal (positive) or distal

  constexpr bool operator==(const Command&) const = default;
};

/// One tick's input. Frame Patient, in which the hand keeps still.
struct Input {
  Vec3 tip_in_patient;             ///< where the hand wants the instrument's tip [mm]
  Vec3 shaft_in_patient{0, 0, 1};  ///< from the tip towards the hand; need not be normalised
  double thrust_n = 0.0;           ///< push of the hand along the shaft towards the tip, 0 to 60 N
  Driver driver = Driver::Off;
  Command command;

  constexpr bool operator==(const Input&) const = default;
};
static_assert(std::is_trivially_copyable_v<Input>);

}  // namespace carpus::simulation
