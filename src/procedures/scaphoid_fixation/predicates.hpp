// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What completes the steps of scaphoid fixation, over whichever pole: a tick means done rightly
// (docs/scoring.md). Run in every tick: no allocation, only + - * / and sqrt.
#pragma once

#include <array>

#include "procedure/procedure.hpp"

namespace carpus::procedures::scaphoid_fixation {

using procedure::Situation;

/// PA and lateral were seen, and it was said whether the fracture is displaced.
[[nodiscard]] bool is_surveyed(const Situation& now) noexcept;
/// A picture looked down the bone within 12 degrees: the ring.
[[nodiscard]] bool is_ring_seen(const Situation& now) noexcept;
/// A bone in one piece, surveyed; or its two pieces lie within 1.5 mm and 10 degrees of each
/// other's faces, and were seen so in PA and lateral since the survey.
[[nodiscard]] bool is_reduced(const Situation& now) noexcept;
/// The pieces lie farther from each other.
[[nodiscard]] bool is_displaced(const Situation& now) noexcept;
[[nodiscard]] bool lies_apart(const procedure::FractureFacts& fracture) noexcept;
/// A wire lies in the scaphoid that went in where the aim's entry is.
[[nodiscard]] bool is_entry_right(const Situation& now) noexcept;
/// A wire is 4 mm deep on a line that is at least 85 % as long as the longest.
[[nodiscard]] bool is_line_long(const Situation& now) noexcept;
/// A wire's tip lies within 2.5 mm under the far cortex.
[[nodiscard]] bool is_driven(const Situation& now) noexcept;
/// The same, and since then it was seen in PA, lateral and the 45 degree pronated oblique.
[[nodiscard]] bool is_checked(const Situation& now) noexcept;
/// A wire's near end lies level with the bone, at most 3 mm in it: the wrist can be extended.
[[nodiscard]] bool is_flush(const Situation& now) noexcept;
/// Since then it was seen in PA and lateral with the wrist straight.
[[nodiscard]] bool is_seen_extended(const Situation& now) noexcept;
/// A wire that was drawn through stands out again where it went in, its tip under the far cortex.
[[nodiscard]] bool is_driven_back(const Situation& now) noexcept;
/// The gauge was read on a wire, within 1.5 mm of the way between the cortices.
[[nodiscard]] bool is_measured(const Situation& now) noexcept;
/// Measured, a wire stands out of the skin at both ends.
[[nodiscard]] bool is_held_at_both_ends(const Situation& now) noexcept;
/// A drill stopped 0.5 to 4 mm before the far cortex.
[[nodiscard]] bool is_reamed(const Situation& now) noexcept;
/// A screw is in a hand or in the scaphoid that is 4 to 6.6 mm shorter than was measured.
[[nodiscard]] bool is_screw_chosen(const Situation& now) noexcept;
/// A screw's tail lies 1 to 4 mm deep and its tip at least 0.5 mm before the far cortex.
[[nodiscard]] bool is_screw_seated(const Situation& now) noexcept;
/// A screw lies in the scaphoid and no wire does.
[[nodiscard]] bool is_wire_out(const Situation& now) noexcept;
/// A screw is seated that all four views have shown since.
[[nodiscard]] bool is_verified(const Situation& now) noexcept;
/// Neither wire nor screw lies in the scaphoid: what was done on that line is to be done again.
[[nodiscard]] bool has_no_line(const Situation& now) noexcept;

/// All of these by name.
[[nodiscard]] constexpr auto named_predicates() {
  using procedure::NamedPredicate;
  return std::array{
      NamedPredicate{"is_surveyed", is_surveyed},
      NamedPredicate{"is_reduced", is_reduced},
      NamedPredicate{"is_displaced", is_displaced},
      NamedPredicate{"is_ring_seen", is_ring_seen},
      NamedPredicate{"is_entry_right", is_entry_right},
      NamedPredicate{"is_line_long", is_line_long},
      NamedPredicate{"is_driven", is_driven},
      NamedPredicate{"is_checked", is_checked},
      NamedPredicate{"is_flush", is_flush},
      NamedPredicate{"is_seen_extended", is_seen_extended},
      NamedPredicate{"is_driven_back", is_driven_back},
      NamedPredicate{"is_measured", is_measured},
      NamedPredicate{"is_held_at_both_ends", is_held_at_both_ends},
      NamedPredicate{"is_reamed", is_reamed},
      NamedPredicate{"is_screw_chosen", is_screw_chosen},
      NamedPredicate{"is_screw_seated", is_screw_seated},
      NamedPredicate{"is_wire_out", is_wire_out},
      NamedPredicate{"is_verified", is_verified},
      NamedPredicate{"has_no_line", has_no_line},
      NamedPredicate{"has_no_screw",
                     [](const Situation& now) noexcept { return !is_screw_chosen(now); }},
      NamedPredicate{"is_screw_unseated",
                     [](const Situation& now) noexcept { return !is_screw_seated(now); }},
      NamedPredicate{"has_wire_again",
                     [](const Situation& now) noexcept { return !is_wire_out(now); }},
  };
}

}  // namespace carpus::procedures::scaphoid_fixation
