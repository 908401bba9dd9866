// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/asset_table.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"

namespace carpus::data {
std::string_view asset();
}

namespace carpus::arthroscopy {
namespace {

using Json = nlohmann::json;

/// As the protocol's asset_answer has it.
constexpr int kHighestPoints = 5;
constexpr std::size_t kLongestId = 32;
constexpr std::size_t kMostRows = 16;

[[noreturn]] void refuse(const std::string& what) { throw InvalidInput("asset.json: " + what); }

AssetStep step_from(const Json& json, const AssetDomain& domain) {
  AssetStep step{json.at("points"), json.at("text")};
  const int before = domain.steps.empty() ? 0 : domain.steps.back().points;
  if (step.points <= before || step.points > domain.highest) {
    refuse(domain.id + ": steps go up from 1 to its highest");
  }
  if (step.text.empty()) refuse(domain.id + ": a step says what it means");
  return step;
}

AssetDomain domain_from(const Json& json, const std::string& where) {
  AssetDomain domain;
  try {
    domain.id = json.at("id");
    domain.title = json.at("title");
    domain.highest = json.at("highest");
    if (domain.id.empty() || domain.id.size() > kLongestId || domain.title.empty()) {
      refuse(where + ": has an id of at most 32 bytes and a title");
    }
    if (domain.highest < 2 || domain.highest > kHighestPoints) {
      refuse(domain.id + ": its highest is 2 to 5");
    }
    for (const Json& each : json.at("steps")) domain.steps.push_back(step_from(each, domain));
    if (json.at("mark").get<std::string>().empty()) refuse(domain.id + ": says where it is from");
  } catch (const Json::exception& error) {
    refuse((domain.id.empty() ? where : domain.id) + ": " + error.what());
  }
  if (domain.steps.empty() || domain.steps.front().points != 1 ||
      domain.steps.back().points != domain.highest) {
    refuse(domain.id + ": its lowest and its highest step have words");
  }
  return domain;
}

const AssetDomain* find(const AssetTable& table, std::string_view id) {
  if (table.complexity.id == id) return &table.complexity;
  for (const AssetDomain& domain : table.domains) {
    if (domain.id == id) return &domain;
  }
  return nullptr;
}

}  // namespace

std::optional<std::string> AssetTable::problem_of(std::span<const AssetChoice> answers) const {
  std::set<std::string_view> seen;
  for (const AssetChoice& each : answers) {
    const AssetDomain* domain = find(*this, each.domain);
    if (domain == nullptr) return "The form has no row '" + each.domain + "'.";
    if (!seen.insert(each.domain).second) return domain->title + " is answered twice.";
    if (each.points < 1 || each.points > domain->highest) {
      return domain->title + " has 1 to " + std::to_string(domain->highest) + " points, not " +
             std::to_string(each.points) + ".";
    }
  }
  return std::nullopt;
}

std::optional<AssetResult> AssetTable::result_of(std::span<const AssetChoice> answers) const {
  if (answers.size() != domains.size() + 1) return std::nullopt;
  AssetResult result{0, true};
  for (const AssetChoice& each : answers) {
    if (each.domain == complexity.id) continue;
    result.total += each.points;
    if (each.points < passes_at) result.passes = false;
  }
  return result;
}

AssetTable AssetTable::parse(std::string_view json_text) {
  AssetTable table;
  try {
    const Json json = Json::parse(json_text);
    table.passes_at = json.at("passes_at").at("value");
    for (const Json& each : json.at("domains")) {
      table.domains.push_back(
          domain_from(each, "domain " + std::to_string(table.domains.size() + 1)));
    }
    table.complexity = domain_from(json.at("complexity"), "complexity");
    int highest_total = 0;
    std::set<std::string> ids{table.complexity.id};
    for (const AssetDomain& domain : table.domains) {
      if (!ids.insert(domain.id).second) refuse(domain.id + ": is there twice");
      if (table.passes_at < 1 || table.passes_at > domain.highest) {
        refuse(domain.id + ": has no step of passes_at");
      }
      highest_total += domain.highest;
    }
    if (table.domains.empty() || ids.size() > kMostRows) refuse("domains: 1 to 15");
    if (json.at("highest_total").at("value") != highest_total) {
      refuse("highest_total: the domains' highest make " + std::to_string(highest_total));
    }
  } catch (const Json::exception& error) {
    refuse(error.what());
  }
  return table;
}

const AssetTable& AssetTable::built_in() {
  static const AssetTable kTable = parse(data::asset());
  return kTable;
}

}  // namespace carpus::arthroscopy
