// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How near to tendons, arteries and nerves something turned or went into a joint
// (docs/decisions/0057-what-harms-a-structure.md). Where they are: cases/laid_structures.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cases/laid_structures.hpp"
#include "simulation/detail/operation_state.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation::detail {

/// What came near a structure so far; no undo takes it back.
struct StructureHarm {
  double least_mm = cases::kFarFromStructureMm;  ///< surface to surface, while something turned or
                                                 ///< entered a joint
  bool was_struck = false;
  InstrumentIndex by = kNoInstrument;  ///< that came nearest
};

struct StructureState {
  std::uint8_t count = 0;  ///< as many as the case has
  std::array<StructureHarm, cases::kMaxStructures> harm{};
  /// By item: a sleeve stood round it when it went into bone, so that its way to the bone is
  /// spread.
  std::array<bool, kMaxItems> is_led{};
};

template <Is<StructureState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  v(state.count);
  for (std::size_t i = 0; i < state.count && i < cases::kMaxStructures; ++i) {
    v(state.harm[i].least_mm);
    v(state.harm[i].was_struck);
    v(state.harm[i].by);
  }
  for (auto& led : state.is_led) v(led);
}

/// Whether a tick could have left it in a case with so many structures.
[[nodiscard]] bool is_possible(const StructureState& state,
                               std::size_t structures,
                               std::size_t instruments) noexcept;

}  // namespace carpus::simulation::detail
