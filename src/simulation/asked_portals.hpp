// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "cases/case_data.hpp"
#include "procedure/portal_making.hpp"

namespace carpus::simulation {

/// In the map's portals those that are to be made, in order: the first as declared, the second one
/// of those that can be asked for on this case (procedure/second_portals.hpp), drawn by the seed;
/// none where the case lacks them.
[[nodiscard]] std::optional<std::array<std::uint8_t, procedure::kPortalsMade>> asked_portals(
    const cases::CaseData& data,
    const procedure::PortalMaking& making,
    std::uint64_t seed);

}  // namespace carpus::simulation
