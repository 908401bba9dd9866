// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an operator does in one tick: the only way anything reaches the simulation, from whatever
// device, script or recording. Two hands, the wrist that is operated on, the C-arm, one command.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "geometry/vec3.hpp"
#include "procedure/fluid_use.hpp"
#include "procedure/situation.hpp"

namespace carpus::simulation {

using instruments::InstrumentIndex;
using instruments::kNoInstrument;
using procedure::kHands;
using procedure::WristPose;

/// What turns the instrument in a hand.
enum class Driver : std::uint8_t { Off = 0, Forward = 1, Reverse = 2 };

/// Things done once rather than held.
enum class CommandKind : std::uint8_t {
  None = 0,
  TakeShot = 1,   ///< one fluoroscopy image from `rotation_deg`, `tilt_deg`
  Take = 2,       ///< `hand` takes instrument `index` of the catalogue from the tray
  PickUp = 3,     ///< `hand` takes hold of item `index`, which lies in bone, where it went in
  PutDown = 4,    ///< `hand` lets go: what stays in bone stays, the rest goes back to the tray
  ReadGauge = 5,  ///< the gauge in `hand` is read
  Undo = 6,       ///< back to the last checkpoint; counted, time and shots stay spent
  Finish = 7,     ///< end the operation
  ForgetCheckpoints = 8,  ///< a host went on from a keyframe: undo does not reach back before now
  PickUpFarEnd = 9,       ///< `hand` takes hold of item `index` at its other end, beyond the bone
  Decline = 10,    ///< end it without a fixation; bit i of `index`: for the procedure's reason i
  UseAid = 11,     ///< `index`: which procedure::Aid; practice only
  SetTube = 12,    ///< `index`: a procedure::TubeSetting, from the next pulse on
  TurnScope = 13,  ///< the scope's shaft is turned to `rotation_deg`, its camera head to `tilt_deg`
  Answer = 14,     ///< of an examination: `index` is packed by answer_index
  /// Back to the last checkpoint at which step `index` was not done; practice only, counted as one
  /// undo.
  ReturnToStep = 15,
  /// `index`: which procedure::Judgement of the fracture; before anything is drilled.
  Judge = 16,
  TurnMouth = 17,  ///< the shaver in `hand` is turned, its mouth with it, to `rotation_deg`
  SetFluid = 18,   ///< of the joint: `index` is packed by fluid_index
};
inline constexpr std::uint8_t kCommandKinds = 19;

/// After it the state is not one that follows from the tick before.
[[nodiscard]] constexpr bool goes_back(CommandKind kind) noexcept {
  return kind == CommandKind::Undo || kind == CommandKind::ReturnToStep;
}

/// What is answered of a finding; 15 takes the answer back.
inline constexpr std::uint8_t kGradesAFinding = 16;
inline constexpr std::uint8_t kNoGrade = kGradesAFinding - 1;
[[nodiscard]] constexpr std::uint8_t answer_index(std::size_t finding,
                                                  std::uint8_t grade) noexcept {
  return static_cast<std::uint8_t>(finding * kGradesAFinding + grade);
}

/// A procedure::FluidControl and its value.
inline constexpr std::uint8_t kFluidValues = 64;
[[nodiscard]] constexpr std::uint8_t fluid_index(procedure::FluidControl control,
                                                 std::uint8_t value) noexcept {
  return static_cast<std::uint8_t>(static_cast<std::uint8_t>(control) * kFluidValues + value);
}

struct Command {
  CommandKind kind = CommandKind::None;
  std::uint8_t hand = 0;
  std::uint8_t index = 0;
  double rotation_deg = 0.0;  ///< TakeShot: of the C-arm, from the forearm as scanned
  double tilt_deg = 0.0;      ///< TakeShot: towards proximal (positive) or distal

  constexpr bool operator==(const Command&) const = default;
};

/// How a hand's wish becomes motion.
enum class Guidance : std::uint8_t {
  Direct = 0,   ///< a device's pose, a script's: followed as it is
  Planned = 1,  ///< a pointer's: far ways at a hand's speed, lifted over what is in the way
};

/// One hand. Frame Patient, in which the ulna keeps still.
struct HandInput {
  Vec3 tip_in_patient;             ///< where it wants the instrument's tip [mm]
  Vec3 shaft_in_patient{0, 0, 1};  ///< from the tip towards the hand; need not be normalised
  double thrust_n = 0.0;           ///< push along the shaft towards the tip, 0 to 60 N
  Driver driver = Driver::Off;
  Guidance guidance = Guidance::Direct;

  constexpr bool operator==(const HandInput&) const = default;
};

/// The C-arm, as it stands in the room, and its foot pedal.
struct CArmInput {
  double rotation_deg = 0.0;   ///< from the forearm as scanned
  double tilt_deg = 0.0;       ///< towards proximal (positive) or distal
  bool pedal_is_down = false;  ///< live pictures, kPulsesPerSecond of them

  constexpr bool operator==(const CArmInput&) const = default;
};

struct Input {
  std::array<HandInput, kHands> hands;
  WristPose wrist;  ///< where it is wanted; it follows at a hand's speed, within its limits
  CArmInput c_arm;
  Command command;

  constexpr bool operator==(const Input&) const = default;
};
static_assert(std::is_trivially_copyable_v<Input>);

/// The input as recordings hold it and the world uses it (quantisation.hpp): positions to 1/1024
/// mm, directions and angles to 1/16384, forces to 1/64 N. Idempotent. What is not finite becomes a
/// number that the world refuses.
[[nodiscard]] Input quantised(const Input& input) noexcept;

}  // namespace carpus::simulation
