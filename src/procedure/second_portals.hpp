// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/portal_making.hpp"

namespace carpus::procedure {

/// In the map's portals those of the declared second ones that can be asked for on this case: it
/// has room for them and, where the procedure demands that, all that they endanger. What is not
/// generated cannot be seen to be spared.
[[nodiscard]] std::vector<std::uint8_t> second_portals(const cases::CaseData& data,
                                                       const PortalMaking& making);

}  // namespace carpus::procedure
