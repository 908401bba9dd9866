// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Events of the simulation in words, for the log on the page and in the records.
#pragma once

#include <string>
#include <string_view>

#include "protocol/types.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::server {

/// "touched_bone", …
[[nodiscard]] std::string_view name_of(simulation::EventKind kind) noexcept;

[[nodiscard]] protocol::LoggedEvent describe(const simulation::Event& event);

/// "scaphoid_proximal" for a bone's label, "" for 0 and labels that are no bone.
[[nodiscard]] std::string bone_name_of_label(int label, bool broken_scaphoid);

}  // namespace carpus::server
