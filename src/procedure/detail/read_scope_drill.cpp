// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_scope_drill.hpp"

#include <string>

#include "procedure/detail/read_tour_places.hpp"

namespace carpus::procedure::detail {
namespace {

constexpr std::size_t kLeastLine = 2;

}  // namespace

ScopeDrill read_scope_drill(JsonFields& fields) {
  ScopeDrill drill;
  drill.hold = read_tour_places(fields, "hold", kMaxDrillPlaces);
  drill.hold_s = fields.number("hold_s", 0.5, 60);
  drill.middle_deg = fields.number("middle_deg", 1, 60);
  drill.still_mm = fields.number("still_mm", 0.1, 20);
  drill.round_places = static_cast<std::size_t>(fields.number("round_places", 1, kLastPlace));
  drill.round_turn_deg = fields.number("round_turn_deg", 0, 720);
  drill.touch = read_tour_places(fields, "touch", kMaxDrillPlaces);
  drill.touch_mm = fields.number("touch_mm", 0.5, 10);
  drill.line = read_tour_places(fields, "line", kMaxDrillPlaces);
  if (drill.line.size() < kLeastLine) fields.refuse("line: one place is no line");
  drill.line_mm = fields.number("line_mm", 0.5, 10);
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
  return drill;
}

}  // namespace carpus::procedure::detail
