// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/input_units.hpp"

#include <algorithm>
#include <cstddef>

#include "simulation/quantisation.hpp"

namespace carpus::simulation {
namespace {

double from_units(std::int64_t units, double unit) { return static_cast<double>(units) * unit; }

template <std::size_t Count>
bool are_inputs(const std::array<std::int64_t, Count>& values) {
  return std::ranges::all_of(values, [](std::int64_t value) {
    return value >= static_cast<std::int64_t>(-kMostUnits) && value <= kNoInputUnits;
  });
}

}  // namespace

InputUnits in_units(const Input& input) noexcept {
  InputUnits units;
  for (std::size_t h = 0; h < kHands; ++h) {
    const HandInput& hand = input.hands[h];
    InputUnits::Hand& out = units.hands[h];
    for (std::size_t i = 0; i < 3; ++i) {
      out.tip[i] = units_of(hand.tip_in_patient[i], kPositionUnitMm);
      out.shaft[i] = units_of(hand.shaft_in_patient[i], kDirectionUnit);
    }
    out.thrust = units_of(hand.thrust_n, kForceUnitN);
    out.driver = static_cast<std::uint8_t>(hand.driver);
    out.guidance = static_cast<std::uint8_t>(hand.guidance);
  }
  units.wrist = {units_of(input.wrist.flexion_rad, kAngleUnitRad),
                 units_of(input.wrist.radial_deviation_rad, kAngleUnitRad),
                 units_of(input.wrist.pronation_rad, kAngleUnitRad),
                 units_of(input.wrist.traction_n, kForceUnitN)};
  units.c_arm = {{units_of(input.c_arm.rotation_deg, kViewUnitDeg),
                  units_of(input.c_arm.tilt_deg, kViewUnitDeg)},
                 static_cast<std::uint8_t>(input.c_arm.pedal_is_down)};
  const Command& command = input.command;
  units.command = {
      static_cast<std::uint8_t>(command.kind),
      command.hand,
      command.index,
      {units_of(command.rotation_deg, kViewUnitDeg), units_of(command.tilt_deg, kViewUnitDeg)}};
  return units;
}

Input input_of(const InputUnits& units) noexcept {
  Input input;
  for (std::size_t h = 0; h < kHands; ++h) {
    const InputUnits::Hand& hand = units.hands[h];
    HandInput& out = input.hands[h];
    for (std::size_t i = 0; i < 3; ++i) {
      out.tip_in_patient[i] = from_units(hand.tip[i], kPositionUnitMm);
      out.shaft_in_patient[i] = from_units(hand.shaft[i], kDirectionUnit);
    }
    out.thrust_n = from_units(hand.thrust, kForceUnitN);
    out.driver = static_cast<Driver>(hand.driver);
    out.guidance = static_cast<Guidance>(hand.guidance);
  }
  input.wrist = {
      from_units(units.wrist[0], kAngleUnitRad), from_units(units.wrist[1], kAngleUnitRad),
      from_units(units.wrist[2], kAngleUnitRad), from_units(units.wrist[3], kForceUnitN)};
  input.c_arm = {from_units(units.c_arm.stand[0], kViewUnitDeg),
                 from_units(units.c_arm.stand[1], kViewUnitDeg), units.c_arm.pedal != 0};
  const InputUnits::What& command = units.command;
  input.command = {static_cast<CommandKind>(command.kind), command.hand, command.index,
                   from_units(command.view[0], kViewUnitDeg),
                   from_units(command.view[1], kViewUnitDeg)};
  return input;
}

bool is_an_input(const InputUnits& units) noexcept {
  for (const InputUnits::Hand& hand : units.hands) {
    const bool is_one = are_inputs(hand.tip) && are_inputs(hand.shaft) &&
                        are_inputs(std::array{hand.thrust}) &&
                        hand.driver <= static_cast<std::uint8_t>(Driver::Reverse) &&
                        hand.guidance <= static_cast<std::uint8_t>(Guidance::Planned);
    if (!is_one) return false;
  }
  return are_inputs(units.wrist) && are_inputs(units.c_arm.stand) && units.c_arm.pedal <= 1 &&
         units.command.kind < kCommandKinds && are_inputs(units.command.view);
}

}  // namespace carpus::simulation
