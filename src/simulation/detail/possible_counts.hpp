// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an arthroscopy counts grows with its ticks: what was counted more often, or for longer, than
// there were ticks for it is of a forged keyframe. Beside what each part of the state knows of
// itself (its is_possible).
#pragma once

#include <cstddef>

#include "cases/arthroscopic_map.hpp"
#include "core/units.hpp"
#include "simulation/detail/joint_fluid.hpp"
#include "simulation/detail/loose_bodies.hpp"
#include "simulation/detail/portal_making.hpp"
#include "simulation/detail/punches.hpp"
#include "simulation/detail/scope_drill.hpp"
#include "simulation/detail/scope_watch.hpp"
#include "simulation/detail/scuffs.hpp"
#include "simulation/detail/shaving.hpp"

namespace carpus::simulation::detail {

/// @param now  ticks that have passed
/// @param lesions  how many there are to be seen
[[nodiscard]] bool are_counts_possible(const ScopeState& state,
                                       Tick now,
                                       const cases::ArthroscopicMap& map,
                                       std::size_t lesions) noexcept;
[[nodiscard]] bool are_counts_possible(const ScopeConduct& conduct, Tick now) noexcept;
[[nodiscard]] bool are_counts_possible(const DrillState& state, Tick now) noexcept;
[[nodiscard]] bool are_counts_possible(const LooseState& state, Tick now) noexcept;
[[nodiscard]] bool are_counts_possible(const ShavingState& state, Tick now) noexcept;
[[nodiscard]] bool are_counts_possible(const PunchState& state, Tick now) noexcept;
[[nodiscard]] bool are_counts_possible(const JointFluid& fluid, Tick now) noexcept;
[[nodiscard]] bool are_counts_possible(const MakingState& state, Tick now) noexcept;

}  // namespace carpus::simulation::detail
