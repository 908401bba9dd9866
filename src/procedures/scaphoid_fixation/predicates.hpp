// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What completes the steps of scaphoid fixation, over whichever pole (docs/scoring.md). Run in
// every tick: no allocation, plain comparisons.
#pragma once

#include <array>
#include <cstddef>

#include "procedure/procedure.hpp"

namespace carpus::procedures::scaphoid_fixation {

using procedure::Situation;

/// Two different views among all shots.
[[nodiscard]] bool is_surveyed(const Situation& now) noexcept;
/// A wire in a hand touches the scaphoid.
[[nodiscard]] bool wire_touches_target(const Situation& now) noexcept;
/// A wire lies in the scaphoid.
[[nodiscard]] bool is_wire_in_target(const Situation& now) noexcept;
/// A wire is as deep as 60 % of its line's length in the scaphoid.
[[nodiscard]] bool is_driven(const Situation& now) noexcept;
/// Since step `drive` was done: two different views, one of them the 45 degree pronated oblique.
[[nodiscard]] bool is_checked(const Situation& now, std::size_t drive) noexcept;
/// The gauge was read on a wire that lies in the scaphoid.
[[nodiscard]] bool is_measured(const Situation& now) noexcept;
/// A reamer was as deep as 60 % of its wire's line.
[[nodiscard]] bool is_reamed(const Situation& now) noexcept;
/// A screw is in a hand or in the scaphoid.
[[nodiscard]] bool is_screw_chosen(const Situation& now) noexcept;
/// A screw's tail is level with the scaphoid's surface or deeper.
[[nodiscard]] bool is_screw_seated(const Situation& now) noexcept;
/// Finishing with a seated screw that the last shot showed seated, step `insert` being done.
[[nodiscard]] bool is_verified(const Situation& now, std::size_t insert) noexcept;
/// Neither wire nor screw lies in the scaphoid: what was done on that line is to be done again.
[[nodiscard]] bool has_no_line(const Situation& now) noexcept;

/// All of these by name, for a procedure whose steps `drive` and `insert` have these places.
template <std::size_t Drive, std::size_t Insert>
[[nodiscard]] constexpr auto named_predicates() {
  using procedure::NamedPredicate;
  return std::array{
      NamedPredicate{"is_surveyed", is_surveyed},
      NamedPredicate{"wire_touches_target", wire_touches_target},
      NamedPredicate{"is_wire_in_target", is_wire_in_target},
      NamedPredicate{"is_driven", is_driven},
      NamedPredicate{"is_checked",
                     [](const Situation& now) noexcept { return is_checked(now, Drive); }},
      NamedPredicate{"is_measured", is_measured},
      NamedPredicate{"is_reamed", is_reamed},
      NamedPredicate{"is_screw_chosen", is_screw_chosen},
      NamedPredicate{"is_screw_seated", is_screw_seated},
      NamedPredicate{"is_verified",
                     [](const Situation& now) noexcept { return is_verified(now, Insert); }},
      NamedPredicate{"has_no_line", has_no_line},
      NamedPredicate{"has_no_screw",
                     [](const Situation& now) noexcept { return !is_screw_chosen(now); }},
      NamedPredicate{"is_screw_unseated",
                     [](const Situation& now) noexcept { return !is_screw_seated(now); }},
  };
}

}  // namespace carpus::procedures::scaphoid_fixation
