// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_tour_places.hpp"

namespace carpus::procedure::detail {

std::vector<std::uint8_t> read_tour_places(JsonFields& fields,
                                           const std::string& field,
                                           std::size_t most) {
  const nlohmann::json& list = fields.value(field);
  std::vector<std::uint8_t> places;
  if (!list.is_array() || list.empty() || list.size() > most) {
    fields.refuse(field + " must be a list of 1 to " + std::to_string(most) +
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

}  // namespace carpus::procedure::detail
