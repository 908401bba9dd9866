// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/units.hpp"
#include "instruments/instrument.hpp"
#include "simulation/input.hpp"

namespace carpus::trainee::detail {

/// In which the wrist comes to where it is wanted.
inline constexpr Tick kWristTicks = 3000;

[[nodiscard]] inline const instruments::Instrument& kind_of(instruments::InstrumentIndex index) {
  return instruments::catalogue()[index];
}

[[nodiscard]] inline simulation::Command take(std::uint8_t hand,
                                              instruments::InstrumentIndex instrument) {
  simulation::Command command;
  command.kind = simulation::CommandKind::Take;
  command.hand = hand;
  command.index = instrument;
  return command;
}

[[nodiscard]] inline simulation::Command of_hand(simulation::CommandKind kind, std::uint8_t hand) {
  simulation::Command command;
  command.kind = kind;
  command.hand = hand;
  return command;
}

}  // namespace carpus::trainee::detail
