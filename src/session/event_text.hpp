// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Events of the simulation in words, for the log on the page and in the records.
#pragma once

#include <optional>
#include <string_view>

#include "procedure/procedure.hpp"
#include "protocol/types.hpp"
#include "session/body_names.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// "touched_bone", …
[[nodiscard]] std::string_view name_of(simulation::EventKind kind) noexcept;

[[nodiscard]] protocol::LoggedEvent describe(const simulation::Event& event,
                                             const procedure::Procedure& procedure,
                                             const BodyNames& bodies);

/// The same as it is told in an assessed operation: nothing that eyes, hand and C-arm do not show.
[[nodiscard]] std::optional<protocol::LoggedEvent> describe_blind(
    const simulation::Event& event,
    const procedure::Procedure& procedure,
    const BodyNames& bodies);

/// An event that was described, as it would have been told blind: nothing where it would not.
[[nodiscard]] std::optional<protocol::LoggedEvent> blinded(protocol::LoggedEvent told);

}  // namespace carpus::session
