// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/structure_watch.hpp"

namespace carpus::simulation::detail {

bool is_possible(const StructureState& state,
                 std::size_t structures,
                 std::size_t instruments) noexcept {
  if (state.count != structures || structures > cases::kMaxStructures) return false;
  for (std::size_t i = 0; i < state.count; ++i) {
    const StructureHarm& harm = state.harm[i];
    const bool is_near =
        harm.least_mm <= cases::kFarFromStructureMm && harm.least_mm >= -cases::kFarFromStructureMm;
    if (!is_near || (harm.by != kNoInstrument && harm.by >= instruments)) return false;
  }
  return true;
}

}  // namespace carpus::simulation::detail
