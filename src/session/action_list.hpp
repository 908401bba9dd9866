// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What can be asked for now, and why the rest cannot: by simulation/permission.hpp alone, the rule
// by which the world refuses.
#pragma once

#include "procedure/procedure.hpp"
#include "protocol/messages.hpp"
#include "session/body_names.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// In a fixed order: of each hand taking what is on the tray, putting down, reading the gauge and
/// picking up what lies in bone; then picture, undo, finish.
[[nodiscard]] protocol::Actions actions_message(const procedure::Procedure& procedure,
                                                const simulation::Snapshot& now,
                                                const BodyNames& bodies);

}  // namespace carpus::session
