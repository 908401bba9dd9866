// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/screw_table.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"

namespace carpus::data {
std::string_view screw_control();
}

namespace carpus::arthroscopy {
namespace {

using Json = nlohmann::json;

/// In the order of ScrewFault.
constexpr std::array<std::string_view, cases::kScrewFaults> kFaults{
    "harmless", "not_turned_in", "too_long", "off_axis", "through"};
constexpr double kChancesOff = 1e-9;

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("screw_control.json: " + what);
}

std::array<double, 2> range_from(const Json& json, const char* name) {
  const auto range = json.at(name).at("range").get<std::array<double, 2>>();
  if (!(range[0] > 0 && range[1] >= range[0])) {
    refuse(std::string(name) + ": a range of lengths above 0, the least first");
  }
  return range;
}

void read_faults(const Json& json, ScrewTable& table) {
  double sum = 0;
  const Json& faults = json.at("faults");
  if (faults.size() != kFaults.size())
    refuse("faults: there are " + std::to_string(kFaults.size()));
  for (std::size_t i = 0; i < kFaults.size(); ++i) {
    if (faults[i].at("id").get<std::string>() != kFaults[i]) {
      refuse("faults[" + std::to_string(i) + "]: it is " + std::string(kFaults[i]));
    }
    table.chances[i] = faults[i].at("chance");
    if (!(table.chances[i] >= 0)) refuse("faults: a chance is 0 to 1");
    sum += table.chances[i];
  }
  if (!(sum > 1 - kChancesOff && sum < 1 + kChancesOff)) refuse("faults: chances are 1 in all");
}

}  // namespace

ScrewTable ScrewTable::parse(std::string_view json_text) {
  ScrewTable table;
  try {
    const Json json = Json::parse(json_text);
    read_faults(json, table);
    table.proud_mm = range_from(json, "proud_mm");
    table.thread_proud_mm = range_from(json, "thread_proud_mm");
    table.buried_mm = range_from(json, "buried_mm");
    table.flush_share = json.at("flush_share").at("value");
    table.cover_mm = json.at("cover_mm").at("value");
  } catch (const Json::exception& error) {
    refuse(error.what());
  }
  table.questions = PathologyTable::parse_questions(json_text);
  const auto& asked = table.questions;
  const std::array<std::size_t, kScrewDecision + 1> grades{3, 2, 2, 3};
  if (asked.findings.size() != grades.size()) refuse("findings: three sites and the decision");
  for (std::size_t f = 0; f < grades.size(); ++f) {
    if (asked.scale_of(f).grades.size() != grades[f]) {
      refuse(asked.findings[f].id + ": has " + std::to_string(grades[f]) + " grades");
    }
  }
  return table;
}

const ScrewTable& ScrewTable::generic() {
  static const ScrewTable kTable = parse(data::screw_control());
  return kTable;
}

}  // namespace carpus::arthroscopy
