// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/sectioning_table.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"

namespace carpus::data {
std::string_view sectioning();
}  // namespace carpus::data

namespace carpus::soft_tissue {
namespace {

using Json = nlohmann::json;
using Kind = PublishedStatement::Kind;

constexpr double kMostDegrees = 150;  ///< of a wrist, either way
constexpr double kFarthest = 1e6;     ///< where a statement has one limit

void refuse_unknown(const Json& json, const std::set<std::string_view>& known) {
  for (const auto& [key, value] : json.items()) {
    if (!known.contains(key)) throw InvalidInput("unknown field '" + key + "'");
  }
}

std::string text_of(const Json& json, const char* key) {
  std::string text = json.at(key).get<std::string>();
  if (text.empty()) throw InvalidInput(std::string(key) + " is empty");
  return text;
}

double number_of(const Json& json, double low, double high) {
  const double value = json.get<double>();
  if (!(value >= low && value <= high)) throw InvalidInput("a measure is impossible");
  return value;
}

double marked(const Json& json, const char* key, double low, double high) {
  const Json& entry = json.at(key);
  refuse_unknown(entry, {"value", "mark"});
  static_cast<void>(text_of(entry, "mark"));
  return number_of(entry.at("value"), low, high);
}

BoneId bone_named(const std::string& name) {
  const auto named = bone_of(name);
  if (!named || named->part != BonePart::Whole) throw InvalidInput("no bone '" + name + "'");
  return named->bone;
}

std::vector<CapsuleLine> capsule_lines(const Json& json, std::optional<double> slack_mm) {
  static_cast<void>(text_of(json, "mark"));
  const double stiffness = marked(json, "stiffness_n_per_mm", 0, 1000);
  std::vector<CapsuleLine> lines;
  for (const Json& line : json.at("lines")) {
    refuse_unknown(line, {"name", "from", "to", "goes_with"});
    const auto end = [&](const char* key) {
      refuse_unknown(line.at(key), {"ligament", "bone"});
      return CapsuleLine::End{text_of(line.at(key), "ligament"),
                              bone_named(text_of(line.at(key), "bone"))};
    };
    lines.push_back({text_of(line, "name"),
                     {end("from"), end("to")},
                     stiffness,
                     slack_mm,
                     line.value("goes_with", std::string())});
  }
  return lines;
}

void read_capsule(const Json& json, SectioningTable& table, std::string& where) {
  where = "midcarpal_capsule";
  const Json& midcarpal = json.at("midcarpal_capsule");
  refuse_unknown(midcarpal, {"stiffness_n_per_mm", "slack_mm", "mark", "lines"});
  table.capsule = capsule_lines(midcarpal, marked(midcarpal, "slack_mm", 0, 20));
  where = "radiocarpal_capsule";
  const Json& radiocarpal = json.at("radiocarpal_capsule");
  refuse_unknown(radiocarpal, {"stiffness_n_per_mm", "length_at_nm", "mark", "lines"});
  table.capsule_length_at_nm = marked(radiocarpal, "length_at_nm", 0.01, table.moment_nm);
  const std::vector<CapsuleLine> lines = capsule_lines(radiocarpal, std::nullopt);
  table.capsule.insert(table.capsule.end(), lines.begin(), lines.end());
}

Kind kind_of(const std::string& name) {
  if (name == "share") return Kind::Share;
  if (name == "range_change") return Kind::RangeChange;
  if (name == "range_over") return Kind::RangeOver;
  if (name == "range") return Kind::Range;
  if (name == "stiffness") return Kind::Stiffness;
  if (name == "bone_change") return Kind::BoneChange;
  if (name == "bone_flexion") return Kind::BoneFlexion;
  if (name == "sl_angle_change") return Kind::SlAngleChange;
  throw InvalidInput("no kind of statement '" + name + "'");
}

template <typename Entry>
void require_one_of(const std::vector<Entry>& entries, const std::string& id) {
  if (std::none_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.id == id; })) {
    throw InvalidInput("'" + id + "' is not in the table");
  }
}

PublishedStatement statement_of(const Json& json, const SectioningTable& table) {
  refuse_unknown(json,
                 {"id", "kind", "cut", "direction", "position", "other_direction", "other_position",
                  "bone", "low", "high", "published", "mark", "fitted", "why_not"});
  PublishedStatement s;
  s.id = text_of(json, "id");
  s.kind = kind_of(text_of(json, "kind"));
  s.cut = json.value("cut", table.cuts.front().id);
  require_one_of(table.cuts, s.cut);
  const bool is_held =
      s.kind == Kind::BoneChange || s.kind == Kind::BoneFlexion || s.kind == Kind::SlAngleChange;
  const auto place_of = [&](const char* position, const char* direction) {
    const std::string place = text_of(json, is_held ? position : direction);
    if (is_held) {
      require_one_of(table.positions, place);
    } else {
      require_one_of(table.directions, place);
    }
    return place;
  };
  s.place = place_of("position", "direction");
  if (s.kind == Kind::RangeOver || s.kind == Kind::BoneFlexion) {
    s.other_place = place_of("other_position", "other_direction");
  }
  if (s.kind == Kind::Share || s.kind == Kind::BoneChange || s.kind == Kind::BoneFlexion) {
    s.bone = bone_named(text_of(json, "bone"));
    if (s.bone != BoneId::Scaphoid && s.bone != BoneId::Lunate) {
      throw InvalidInput("only scaphoid and lunate are compared");
    }
  }
  s.limits = {json.value("low", -kFarthest), json.value("high", kFarthest)};
  if (!(s.limits.low < s.limits.high) ||
      (s.limits.low == -kFarthest && s.limits.high == kFarthest)) {
    throw InvalidInput("its limits say nothing");
  }
  s.published = text_of(json, "published");
  s.mark = text_of(json, "mark");
  s.is_fitted = json.value("fitted", false);
  s.why_not = json.value("why_not", std::string());
  return s;
}

void read_places(const Json& json, SectioningTable& table, std::string& where) {
  std::set<std::string> ids;
  const auto enter = [&](const Json& entry) {
    where = text_of(entry, "id");
    if (!ids.insert(where).second) throw InvalidInput("is there twice");
    return where;
  };
  for (const Json& d : json.at("directions")) {
    const std::string id = enter(d);
    refuse_unknown(d, {"id", "flexes", "deviates_radially"});
    const double f = number_of(d.at("flexes"), -1, 1);
    const double r = number_of(d.at("deviates_radially"), -1, 1);
    const double length = std::sqrt(f * f + r * r);
    if (!(std::abs(length - 1) < 1e-3)) throw InvalidInput("its length is not 1");
    table.directions.push_back({id, f / length, r / length});
  }
  ids.clear();
  for (const Json& p : json.at("positions")) {
    const std::string id = enter(p);
    refuse_unknown(p, {"id", "flexion_deg", "radial_deviation_deg"});
    table.positions.push_back(
        {id, number_of(p.at("flexion_deg"), -kMostDegrees, kMostDegrees),
         number_of(p.at("radial_deviation_deg"), -kMostDegrees, kMostDegrees)});
  }
  ids.clear();
  for (const Json& c : json.at("cuts")) {
    const std::string id = enter(c);
    refuse_unknown(c, {"id", "name", "without"});
    table.cuts.push_back({id, text_of(c, "name"), c.at("without").get<std::vector<std::string>>()});
    if (table.cuts.back().without.empty() != (table.cuts.size() == 1)) {
      throw InvalidInput("the first cut, and no other, cuts nothing");
    }
  }
  if (table.cuts.empty()) throw InvalidInput("no cuts");
}

}  // namespace

SectioningTable SectioningTable::parse(std::string_view json_text) {
  std::string where = "the table";
  try {
    const Json json = Json::parse(json_text);
    refuse_unknown(json,
                   {"doc", "schema_version", "moment_nm", "steps", "press_n", "holding_n_per_mm",
                    "midcarpal_capsule", "radiocarpal_capsule", "directions", "directions_mark",
                    "positions", "positions_mark", "cuts", "cuts_mark", "published"});
    if (json.at("schema_version") != 1) throw InvalidInput("another schema_version than 1");
    SectioningTable table;
    table.moment_nm = marked(json, "moment_nm", 0.01, 20);
    table.steps = static_cast<std::size_t>(marked(json, "steps", 4, 200));
    table.press_n = marked(json, "press_n", 0, 500);
    table.holding_n_per_mm = marked(json, "holding_n_per_mm", 0.001, 10);
    read_capsule(json, table, where);
    for (const char* key : {"directions_mark", "positions_mark", "cuts_mark"}) {
      where = key;
      static_cast<void>(text_of(json, key));
    }
    read_places(json, table, where);
    for (const Json& s : json.at("published")) {
      where = text_of(s, "id");
      table.published.push_back(statement_of(s, table));
    }
    return table;
  } catch (const Json::exception& error) {
    throw InvalidInput("sectioning: " + where + ": " + error.what());
  } catch (const InvalidInput& error) {
    throw InvalidInput("sectioning: " + where + ": " + error.what());
  }
}

const SectioningTable& SectioningTable::generic() {
  static const SectioningTable table = parse(data::sectioning());
  return table;
}

}  // namespace carpus::soft_tissue
