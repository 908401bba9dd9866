// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The simulation's values as messages of the protocol, and back.
#pragma once

#include <string_view>

#include "cases/case_data.hpp"
#include "protocol/bodies.hpp"
#include "protocol/messages.hpp"
#include "server/simulation_loop.hpp"

namespace carpus::server {

[[nodiscard]] protocol::Snapshot snapshot_message(const LoopState& state,
                                                  bool paused,
                                                  bool broken_scaphoid);

/// What the page may know of the case: no landmark that would give the answer away.
[[nodiscard]] protocol::CaseDescription case_description(const cases::CaseData& posed_case);

[[nodiscard]] HeldTool held_tool(const protocol::Tool& tool) noexcept;

[[nodiscard]] bool has_broken_scaphoid(const cases::CaseData& data);

}  // namespace carpus::server
