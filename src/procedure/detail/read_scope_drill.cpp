// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_scope_drill.hpp"

#include <string>

namespace carpus::procedure::detail {
namespace {

constexpr int kFirstPlace = 1;
constexpr int kLastPlace = 31;
constexpr std::size_t kLeastLine = 2;

std::vector<std::uint8_t> read_places(JsonFields& fields, const std::string& field) {
  const nlohmann::json& list = fields.value(field);
  std::vector<std::uint8_t> places;
  if (!list.is_array() || list.empty() || list.size() > kMaxDrillPlaces) {
    fields.refuse(field + " must be a list of 1 to " + std::to_string(kMaxDrillPlaces) +
                  " places of the tour");
  }
  for (const nlohmann::json& each : list) {
    if (!each.is_number_integer() || each < kFirstPlace || each > kLastPlace) {
      fields.refuse(field + ": " + each.dump() + " is no place of the tour");
    }
    places.push_back(each.get<std::uint8_t>());
  }
  return places;
}

}  // namespace

ScopeDrill read_scope_drill(JsonFields& fields) {
  ScopeDrill drill;
  drill.hold = read_places(fields, "hold");
  drill.hold_s = fields.number("hold_s", 0.5, 60);
  drill.middle_deg = fields.number("middle_deg", 1, 60);
  drill.still_mm = fields.number("still_mm", 0.1, 20);
  drill.round_places = static_cast<std::size_t>(fields.number("round_places", 1, kLastPlace));
  drill.round_turn_deg = fields.number("round_turn_deg", 0, 720);
  drill.touch = read_places(fields, "touch");
  drill.touch_mm = fields.number("touch_mm", 0.5, 10);
  drill.line = read_places(fields, "line");
  if (drill.line.size() < kLeastLine) fields.refuse("line: one place is no line");
  drill.line_mm = fields.number("line_mm", 0.5, 10);
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
  return drill;
}

}  // namespace carpus::procedure::detail
