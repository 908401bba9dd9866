// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What may be done now, and the reason where it may not: one rule for the world, which refuses, and
// for whoever shows it beforehand.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "procedure/procedure.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation {

/// Why a command is refused.
enum class Refusal : std::uint8_t {
  None = 0,  ///< it may be done
  Finished,
  UnknownCommand,
  NoSuchHand,
  ShotOutOfRange,
  TooManyShots,
  NotOnTheTray,
  HandIsFull,  ///< what it holds is in bone and does not stay there: draw it back first
  TooManyItems,
  NoWireToRideOn,  ///< a reamer, gauge or screw needs a wire that lies in the target
  WireIsTaken,     ///< something rides on that wire already
  NothingInHand,
  NothingThere,  ///< no such item, or it is in a hand already
  SomethingRidesOnIt,
  NoGaugeInHand,  ///< nor a wire that is held beside another
  NothingToUndo,
  NoUndoWhenAssessed,
  EndIsInside,        ///< that end of the wire is in the body, or was never double-pointed
  WireIsBent,         ///< what has a bore does not run over it
  NoReasonToDecline,  ///< none was said, or one that the procedure does not know
  NoAidsWhenAssessed,
  NoWayBackToStep,  ///< it is not done, or no checkpoint before that is kept
  TooLateToJudge,   ///< bone was entered
};

/// Plain comparisons on what the last tick left: real-time.
[[nodiscard]] Refusal why_not(const procedure::Procedure& procedure,
                              const Snapshot& now,
                              const Command& command) noexcept;

/// The item on which an instrument with a bore would ride: the wire laid last that fits it, lies in
/// the target and carries nothing yet; kNoItem when there is none.
[[nodiscard]] std::uint8_t wire_to_ride_on(std::span<const instruments::Instrument> catalogue,
                                           const Snapshot& now,
                                           InstrumentIndex instrument) noexcept;

/// The wire that a hand measures: on which its gauge rides, or beside which it holds another, its
/// tip on bone within 6 mm of where that went in and within 15 degrees of its line; kNoItem when
/// there is none [clinical: B1 step 7].
[[nodiscard]] std::uint8_t wire_to_measure(std::span<const instruments::Instrument> catalogue,
                                           const Snapshot& now,
                                           std::uint8_t hand) noexcept;

/// "no_wire_to_ride_on": stable, for the protocol.
[[nodiscard]] std::string_view name_of(Refusal refusal) noexcept;

}  // namespace carpus::simulation
