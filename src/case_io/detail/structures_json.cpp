// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/structures_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "case_io/detail/damaged_file.hpp"
#include "core/error.hpp"
#include "core/json_nesting.hpp"

namespace carpus::case_io {
namespace {

using Json = nlohmann::ordered_json;

/// Half of it would do.
constexpr int kDeepest = 12;
constexpr int kVersion = 1;
/// No wrist lies further from its scanner's origin [mm].
constexpr double kFarthestMm = 1e5;
constexpr double kThickestMm = 10;
constexpr std::size_t kLongestName = 128;

double number_within(const Json& json, double low, double high) {
  const double value = json.get<double>();
  if (!(value >= low && value <= high)) throw IoError("a number is impossible");
  return value;
}

std::string name_from(const Json& json) {
  auto name = json.get<std::string>();
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
  if (name.empty() || name.size() > kLongestName ||
      std::any_of(name.begin(), name.end(), is_control)) {
    throw IoError("a name is empty, too long, or holds control characters");
  }
  return name;
}

cases::Structure structure_from(const Json& json) {
  cases::Structure s;
  s.id = name_from(json.at("id"));
  s.name = name_from(json.at("name"));
  const auto kind = anatomy::structure_kind_of(json.at("kind").get<std::string>());
  if (!kind) throw IoError("a structure is neither tendon, artery nor nerve");
  s.kind = *kind;
  s.radius_mm = number_within(json.at("radius_mm"), 0.05, kThickestMm);
  const auto forearm = bone_of(json.at("forearm").get<std::string>());
  if (!forearm || !belongs_to_forearm(forearm->bone)) {
    throw IoError("a structure's forearm is neither radius nor ulna");
  }
  s.forearm = forearm->bone;
  for (const Json& point : json.at("course_mm")) {
    const auto v = point.get<std::array<Json, 4>>();
    s.course.push_back({{number_within(v[0], -kFarthestMm, kFarthestMm),
                         number_within(v[1], -kFarthestMm, kFarthestMm),
                         number_within(v[2], -kFarthestMm, kFarthestMm)},
                        number_within(v[3], 0, 1)});
  }
  if (s.course.size() < 2 || s.course.size() > cases::kMaxStructurePoints) {
    throw IoError("a course has too few or too many points");
  }
  return s;
}

}  // namespace

std::string structures_text(const std::vector<cases::Structure>& structures) {
  Json json;
  json["format"] = "carpus structures";
  json["schema_version"] = kVersion;
  json["generated"] = true;
  json["note"] = "Generated from the generic wrist and this case's bones; not seen in the CT.";
  json["structures"] = Json::array();
  for (const cases::Structure& s : structures) {
    Json course = Json::array();
    for (const cases::StructurePoint& p : s.course) {
      course.push_back(Json::array({p.at.x, p.at.y, p.at.z, p.hand_share}));
    }
    json["structures"].push_back({{"id", s.id},
                                  {"name", s.name},
                                  {"kind", anatomy::name_of(s.kind)},
                                  {"radius_mm", s.radius_mm},
                                  {"forearm", name_of(s.forearm)},
                                  {"course_mm", course}});
  }
  return json.dump() + "\n";
}

std::vector<cases::Structure> parse_structures(const std::string& text,
                                               const std::filesystem::path& file) {
  try {
    if (nests_deeper_than(text, kDeepest)) throw IoError("nests too deeply");
    const Json json = Json::parse(text);
    if (json.value("format", "") != "carpus structures") throw IoError("is no list of structures");
    if (json.at("schema_version") != kVersion) {
      throw SchemaError(
          file.string() +
          ": was written by a newer program; update carpus, or remove the file and \"structures\" "
          "from case.json: the case then opens without tendons, arteries and nerves");
    }
    std::vector<cases::Structure> structures;
    for (const Json& entry : json.at("structures")) {
      structures.push_back(structure_from(entry));
      if (structures.size() > cases::kMaxStructures) throw IoError("holds too many structures");
    }
    return structures;
  } catch (const Json::exception& error) {
    throw damaged_file(file, error);
  } catch (const IoError& error) {
    throw damaged_file(file, error);
  }
}

}  // namespace carpus::case_io
