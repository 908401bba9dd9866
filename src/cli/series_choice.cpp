// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/series_choice.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "image_formats/refusal.hpp"

namespace carpus::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostSeries = 50;

}  // namespace

std::string series_choice_text(const std::vector<case_io::SeriesSummary>& volumes) {
  Json list = Json::array();
  for (const case_io::SeriesSummary& one : volumes) {
    if (list.size() >= kMostSeries) break;
    list.push_back({{"uid", one.uid},
                    {"description", image_formats::printable(one.description)},
                    {"slices", one.slices},
                    {"spacing_mm", {one.spacing_mm.x, one.spacing_mm.y, one.spacing_mm.z}}});
  }
  const Json whole{{"series", std::move(list)}};
  // What a scanner wrote is not promised to be UTF-8.
  return whole.dump(1, ' ', false, Json::error_handler_t::replace);
}

std::vector<server::SeriesOffer> parse_series_choice(const std::string& text) {
  std::vector<server::SeriesOffer> offers;
  try {
    const Json whole = Json::parse(text);
    for (const Json& one : whole.at("series")) {
      const auto spacing = one.at("spacing_mm").get<std::array<double, 3>>();
      offers.push_back({one.at("uid").get<std::string>(), one.at("description").get<std::string>(),
                        one.at("slices").get<int>(), spacing});
    }
  } catch (const Json::exception&) {
    return {};
  }
  return offers;
}

}  // namespace carpus::cli
