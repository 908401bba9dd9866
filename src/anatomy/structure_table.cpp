// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/structure_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"

namespace carpus::data {
std::string_view structures();
}  // namespace carpus::data

namespace carpus::anatomy {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, kStructureKinds> kKindNames{"tendon", "artery", "nerve"};
/// No wrist is larger, nothing in it longer [mm].
constexpr double kLargestMm = 300;
/// No tendon here is thicker [mm].
constexpr double kThickestMm = 5;
/// A course of fewer points has no direction; more are a mistake.
constexpr std::size_t kFewestPoints = 2;
constexpr std::size_t kMostPoints = 16;

void refuse_unknown(const Json& json, const std::set<std::string_view>& known) {
  for (const auto& [key, value] : json.items()) {
    if (!known.contains(key)) throw InvalidInput("unknown field '" + key + "'");
  }
}

double number_of(const Json& json, double low = -kLargestMm, double high = kLargestMm) {
  const double value = json.get<double>();
  if (!(value >= low && value <= high)) throw InvalidInput("a measure is impossible");
  return value;
}

BoneId bone_named(const Json& json) {
  const auto named = bone_of(json.get<std::string>());
  if (!named || named->part != BonePart::Whole) {
    throw InvalidInput("there is no bone '" + json.get<std::string>() + "'");
  }
  return named->bone;
}

Landmark landmark_of(const Json& json) {
  refuse_unknown(json, {"id", "bone", "at_mm", "words", "mark"});
  const auto at = json.at("at_mm").get<std::array<Json, 3>>();
  return {json.at("id").get<std::string>(),
          bone_named(json.at("bone")),
          {number_of(at[0]), number_of(at[1]), number_of(at[2])}};
}

Place place_of(const Json& json, const std::vector<Landmark>& landmarks) {
  const auto from = json.at("from").get<std::string>();
  const auto landmark = std::find_if(landmarks.begin(), landmarks.end(),
                                     [&](const Landmark& l) { return l.id == from; });
  if (landmark == landmarks.end()) throw InvalidInput("there is no landmark '" + from + "'");
  const auto measure = [&](const char* key) { return number_of(json.value(key, Json(0.0))); };
  Place place;
  place.landmark = static_cast<std::size_t>(landmark - landmarks.begin());
  place.offset = {-measure("distal_mm"), measure("ulnar_mm"), -measure("dorsal_mm")};
  if (json.contains("gap_mm") && json.contains("depth_mm")) {
    throw InvalidInput("a point lies over bone or under the skin, not both");
  }
  if (json.contains("gap_mm")) {
    place.layer = Layer::OverBone;
    place.millimetres = number_of(json.at("gap_mm"), 0, 20);
  } else if (json.contains("depth_mm")) {
    place.layer = Layer::UnderSkin;
    place.millimetres = number_of(json.at("depth_mm"), 0.5, 20);
  }
  return place;
}

TabledStructure structure_of(const Json& json, const std::vector<Landmark>& landmarks) {
  refuse_unknown(
      json, {"id", "name", "kind", "radius_mm", "forearm", "length_mm", "mark", "avoid", "course"});
  TabledStructure s;
  s.id = json.at("id").get<std::string>();
  s.name = json.at("name").get<std::string>();
  const auto kind = structure_kind_of(json.at("kind").get<std::string>());
  if (!kind) throw InvalidInput("a structure is a tendon, an artery or a nerve");
  s.kind = *kind;
  s.radius_mm = number_of(json.at("radius_mm"), 0.1, kThickestMm);
  s.forearm = bone_named(json.at("forearm"));
  if (!belongs_to_forearm(s.forearm)) throw InvalidInput("the forearm's bone is radius or ulna");
  const auto length = json.at("length_mm").get<std::array<Json, 2>>();
  s.shortest_mm = number_of(length[0], 0);
  s.longest_mm = number_of(length[1], s.shortest_mm);
  s.avoid = json.at("avoid").get<std::string>();
  if (json.at("mark").get<std::string>().empty()) throw InvalidInput("a mark is missing");
  for (const Json& point : json.at("course")) {
    refuse_unknown(point, {"from", "distal_mm", "ulnar_mm", "dorsal_mm", "gap_mm", "depth_mm"});
    s.course.push_back(place_of(point, landmarks));
  }
  if (s.course.size() < kFewestPoints || s.course.size() > kMostPoints) {
    throw InvalidInput("the course has too few or too many points");
  }
  return s;
}

TabledPortal portal_of(const Json& json, const std::vector<Landmark>& landmarks) {
  refuse_unknown(json,
                 {"id", "from", "distal_mm", "ulnar_mm", "dorsal_mm", "depth_mm", "published"});
  TabledPortal portal;
  portal.id = json.at("id").get<std::string>();
  portal.place = place_of(json, landmarks);
  for (const Json& p : json.at("published")) {
    portal.published.push_back(
        {p.at("to").get<std::string>(), number_of(p.at("mm"), 0), p.at("mark").get<std::string>()});
  }
  return portal;
}

}  // namespace

std::string_view name_of(StructureKind kind) noexcept {
  return kKindNames[static_cast<std::size_t>(kind) % kKindNames.size()];
}

std::optional<StructureKind> structure_kind_of(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kKindNames.size(); ++i) {
    if (kKindNames[i] == name) return static_cast<StructureKind>(i);
  }
  return std::nullopt;
}

StructureTable StructureTable::parse(std::string_view json_text) {
  std::string where = "the table";
  try {
    const Json json = Json::parse(json_text);
    refuse_unknown(json,
                   {"doc", "schema_version", "at_a_portal", "landmarks", "structures", "portals"});
    if (json.at("schema_version") != 1) throw InvalidInput("another schema_version than 1");
    StructureTable table;
    for (std::size_t i = 0; i < kKindNames.size(); ++i) {
      table.at_a_portal[i] = json.at("at_a_portal").at(std::string(kKindNames[i]));
    }
    std::set<std::string> ids;
    const auto enter = [&](const Json& entry) {
      where = entry.at("id").get<std::string>();
      if (!ids.insert(where).second) throw InvalidInput("is there twice");
    };
    for (const Json& entry : json.at("landmarks")) {
      enter(entry);
      table.landmarks.push_back(landmark_of(entry));
    }
    for (const Json& entry : json.at("structures")) {
      enter(entry);
      table.structures.push_back(structure_of(entry, table.landmarks));
    }
    for (const Json& entry : json.at("portals")) {
      enter(entry);
      table.portals.push_back(portal_of(entry, table.landmarks));
    }
    return table;
  } catch (const Json::exception& error) {
    throw InvalidInput("structures: " + where + ": " + error.what());
  } catch (const InvalidInput& error) {
    throw InvalidInput("structures: " + where + ": " + error.what());
  }
}

const StructureTable& StructureTable::generic() {
  static const StructureTable table = parse(data::structures());
  return table;
}

const TabledStructure* StructureTable::find(std::string_view id) const noexcept {
  for (const TabledStructure& s : structures) {
    if (s.id == id) return &s;
  }
  return nullptr;
}

}  // namespace carpus::anatomy
