// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The instruments that the program is built with.
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "instruments/instrument.hpp"

namespace carpus::data {
std::string_view instruments();
std::string_view screws();
std::string_view arthroscopes();
std::string_view portal_instruments();
std::string_view punches();
}  // namespace carpus::data

namespace carpus::instruments {
namespace {

std::vector<Instrument> built_in() {
  std::vector<Instrument> all = read_instruments(data::instruments(), "instruments.json");
  std::vector<Instrument> screws = read_instruments(data::screws(), "screws.json");
  std::move(screws.begin(), screws.end(), std::back_inserter(all));
  std::vector<Instrument> scopes = read_instruments(data::arthroscopes(), "arthroscopes.json");
  std::move(scopes.begin(), scopes.end(), std::back_inserter(all));
  std::vector<Instrument> of_portals =
      read_instruments(data::portal_instruments(), "portal_instruments.json");
  std::move(of_portals.begin(), of_portals.end(), std::back_inserter(all));
  // Last: states name an instrument by its place here.
  std::vector<Instrument> punches = read_instruments(data::punches(), "punches.json");
  std::move(punches.begin(), punches.end(), std::back_inserter(all));
  if (all.size() >= kNoInstrument)
    throw InvalidInput("instruments.json: more than 254 instruments");
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (all[i].id == all[j].id) {
        throw InvalidInput(
            "instruments.json, screws.json, arthroscopes.json, portal_instruments.json, "
            "punches.json: " +
            all[i].id + ": there are two of it");
      }
    }
  }
  return all;
}

}  // namespace

std::span<const Instrument> catalogue() {
  static const std::vector<Instrument> kCatalogue = built_in();
  return kCatalogue;
}

std::optional<InstrumentIndex> instrument_of(std::string_view id) {
  const auto all = catalogue();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].id == id) return static_cast<InstrumentIndex>(i);
  }
  return std::nullopt;
}

}  // namespace carpus::instruments
