// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/screw_catalogue.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace carpus::data {
std::string_view screws();
}  // namespace carpus::data

namespace carpus::procedure {
namespace {

/// "24" or "22.5".
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

std::vector<Screw> read_catalogue() {
  std::vector<Screw> screws;
  const nlohmann::json file = nlohmann::json::parse(data::screws());
  for (const auto& family : file.at("families")) {
    for (const auto& length : family.at("lengths_mm")) {
      Screw screw;
      screw.family = family.at("id").get<std::string>();
      screw.length_mm = length.get<double>();
      screw.name =
          family.at("name").get<std::string>() + " " + short_number(screw.length_mm) + " mm";
      screw.tip_diameter_mm = family.at("tip_diameter_mm").get<double>();
      screw.tail_diameter_mm = family.at("tail_diameter_mm").get<double>();
      screw.confirmed = family.at("confirmed").get<bool>();
      screws.push_back(std::move(screw));
    }
  }
  return screws;
}

}  // namespace

std::span<const Screw> screw_catalogue() {
  static const std::vector<Screw> kCatalogue = read_catalogue();
  return kCatalogue;
}

int ideal_screw_index(std::span<const Screw> catalogue, double measured_mm) noexcept {
  int best = -1;
  for (std::size_t i = 0; i < catalogue.size(); ++i) {
    const double length = catalogue[i].length_mm;
    if (length <= measured_mm - kMeasuredMinusScrewMm &&
        (best < 0 || length > catalogue[static_cast<std::size_t>(best)].length_mm)) {
      best = static_cast<int>(i);
    }
  }
  return best;
}

}  // namespace carpus::procedure
