// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Exercises for hands that are new to a scope: bring a place to the middle and keep it there, look
// round without moving, touch places in order while they are seen, follow a line. Declared with a
// procedure, by the places of the tour; what was done of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/units.hpp"

namespace carpus::procedure {

/// Most places of one exercise.
inline constexpr std::size_t kMaxDrillPlaces = 8;

/// Places by their number in the tour (cases::TourPoint::number), in order.
struct ScopeDrill {
  std::vector<std::uint8_t> hold;   ///< to be brought to the middle and kept there
  double hold_s = 0;                ///< without a break
  double middle_deg = 0;            ///< from the line of sight
  double still_mm = 0;              ///< that the scope's tip may move meanwhile
  std::size_t round_places = 0;     ///< to be seen from one place, the shaft alone being turned
  double round_turn_deg = 0;        ///< ... by so much in all
  std::vector<std::uint8_t> touch;  ///< by what works beside the scope, while the scope sees it
  double touch_mm = 0;              ///< from the place
  std::vector<std::uint8_t> line;   ///< along which it is led without being lifted
  double line_mm = 0;               ///< that it may go aside

  [[nodiscard]] bool operator==(const ScopeDrill&) const = default;
};

/// What was done of it so far.
struct DrillFacts {
  std::uint8_t held = 0;          ///< places of ScopeDrill::hold
  std::uint32_t hold_breaks = 0;  ///< begun, kept for half a second, and lost
  std::uint8_t round_most = 0;    ///< places seen from one place, at most
  bool is_round_done = false;     ///< ... as many as asked for, the shaft turned as far
  std::uint8_t touched = 0;       ///< places of ScopeDrill::touch
  bool are_touches_done = false;
  std::uint32_t wrong_touches = 0;  ///< of one of them that was not asked for
  double line_share = 0;            ///< of the line, at most [1]
  bool is_line_done = false;
  std::uint32_t line_breaks = 0;  ///< lifted, led aside or on unseen, on the way
  double seen_path_mm = 0;        ///< of what works beside the scope, while the scope saw its tip
  double unseen_path_mm = 0;      ///< ... while it did not
  bool operator==(const DrillFacts&) const = default;
};

}  // namespace carpus::procedure
