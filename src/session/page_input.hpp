// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a page says, in the simulation's terms.
#pragma once

#include "core/result.hpp"
#include "procedure/procedure.hpp"
#include "protocol/messages.hpp"
#include "session/held_input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// Everything at rest where it is: what is held at the beginning, and when nobody holds anything.
[[nodiscard]] HeldInput resting(const simulation::Snapshot& now) noexcept;

/// Takes over what is said of one hand, of the wrist, of the C-arm and its pedal.
/// @param wrist  as it is held now: angles may be counted from it.
void hold(HeldInput& held, const protocol::Hand& message) noexcept;
void hold(HeldInput& held, const protocol::Wrist& message) noexcept;
void hold(HeldInput& held,
          const protocol::CArm& message,
          const simulation::WristPose& wrist) noexcept;
void hold(HeldInput& held, const protocol::Pedal& message) noexcept;

/// A refusal says what is missing or not known, for the page that sent it. Whether it makes sense
/// now, the simulation says.
/// @param procedure  whose reasons a decline names.
[[nodiscard]] Result<simulation::Command> command_of(const protocol::Act& message,
                                                     const procedure::Procedure& procedure);
/// The nearest voltage that the tube has.
[[nodiscard]] simulation::Command command_of(const protocol::Tube& message) noexcept;
[[nodiscard]] simulation::Command command_of(const protocol::TurnScope& message) noexcept;
[[nodiscard]] simulation::Command command_of(const protocol::TurnMouth& message) noexcept;
[[nodiscard]] simulation::Command command_of(const protocol::SetFluid& message) noexcept;
[[nodiscard]] Result<simulation::Command> command_of(const protocol::Answer& message,
                                                     const procedure::Procedure& procedure);
/// @param wrist  as it is held now: angles may be counted from it.
[[nodiscard]] simulation::Command command_of(const protocol::TakeShot& message,
                                             const simulation::WristPose& wrist) noexcept;

}  // namespace carpus::session
