// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_shaving.hpp"

#include <cmath>

#include "cases/tissue_piece.hpp"
#include "procedure/detail/read_tour_places.hpp"

namespace carpus::procedure::detail {
namespace {

constexpr double kMostTufts = 30;
constexpr double kMostMm = 5.0;
constexpr std::size_t kMostPlaces = 16;

std::array<std::uint8_t, 2> least_and_most(JsonFields& fields,
                                           const std::string& field,
                                           double most) {
  const std::vector<double> both = fields.numbers(field, 2, 1, most);
  if (both[0] > both[1]) fields.refuse(field + " is given from least to most");
  for (const double count : both) {
    if (count != std::floor(count)) fields.refuse(field + " counts whole ones");
  }
  return {static_cast<std::uint8_t>(both[0]), static_cast<std::uint8_t>(both[1])};
}

}  // namespace

Shaving read_shaving(JsonFields& fields) {
  Shaving shaving;
  if (fields.has("synovium")) {
    JsonFields synovium = fields.object("synovium");
    InflamedSynovium& made = shaving.synovium.emplace();
    made.patches = least_and_most(synovium, "patches", static_cast<double>(cases::kMaxPatches));
    made.tufts = least_and_most(synovium, "tufts", kMostTufts);
    made.places = read_tour_places(synovium, "places", kMostPlaces);
    if (made.places.size() < made.patches[1]) {
      synovium.refuse("places: fewer than patches, which each stand about one of their own");
    }
    synovium.refuse_unknown_fields();
  }
  if (fields.has("disc")) {
    JsonFields disc = fields.object("disc");
    TornDisc& made = shaving.disc.emplace();
    made.tears = disc.texts_or_none("tears");
    if (made.tears.empty()) disc.refuse("tears: name at least one");
    made.frayed_mm = disc.number("frayed_mm", 0.1, kMostMm);
    made.rim_mm = disc.number("rim_mm", 0.0, kMostMm);
    disc.refuse_unknown_fields();
  }
  if (shaving.synovium.has_value() == shaving.disc.has_value()) {
    fields.refuse("either synovium or disc is shaved");
  }
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
  return shaving;
}

}  // namespace carpus::procedure::detail
