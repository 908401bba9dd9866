// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Why something cannot be done now, for people.
#pragma once

#include <string_view>

#include "simulation/permission.hpp"

namespace carpus::session {

/// One clause without a full stop; empty for Refusal::None.
[[nodiscard]] std::string_view text_of(simulation::Refusal refusal) noexcept;

}  // namespace carpus::session
