// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A screw that is controlled, in the tick: what of its sites was probed in sight, and what was
// known when it was answered. Part of the state of such procedures alone.
#pragma once

#include "cases/controlled_screw.hpp"
#include "procedure/screw_control.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

struct ScrewState {
  procedure::ScrewFacts done;  ///< but for `seen`, which the lesions' look keeps
};

template <Is<ScrewState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  v(state.done.probed);
  v(state.done.answered_seen);
  v(state.done.answered_probed);
  v(state.done.sites_at_decision);
}

/// Whether a tick could have left it.
[[nodiscard]] inline bool is_possible(const ScrewState& state) noexcept {
  constexpr unsigned kSites = (1U << cases::kScrewSites) - 1U;
  constexpr unsigned kAnswers = (1U << (cases::kScrewSites + 1)) - 1U;
  return (state.done.probed & ~kSites) == 0 && (state.done.sites_at_decision & ~kSites) == 0 &&
         (state.done.answered_seen & ~kAnswers) == 0 &&
         (state.done.answered_probed & ~kAnswers) == 0;
}

}  // namespace carpus::simulation::detail
