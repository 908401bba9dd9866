// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/tissue_table.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"

namespace carpus::data {
std::string_view soft_tissue();
}  // namespace carpus::data

namespace carpus::soft_tissue {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 3> kAspects{"dorsal", "volar", "proximal"};
/// No wrist is larger [mm].
constexpr double kLargestMm = 300;
constexpr double kStiffest = 10000;  ///< N/mm; no ligament is
constexpr std::size_t kMostStrands = 16;

void refuse_unknown(const Json& json, const std::set<std::string_view>& known) {
  for (const auto& [key, value] : json.items()) {
    if (!known.contains(key)) throw InvalidInput("unknown field '" + key + "'");
  }
}

void require_mark(const Json& json, const char* key = "mark") {
  if (json.at(key).get<std::string>().empty()) throw InvalidInput("a mark is missing");
}

double number_of(const Json& json, double low, double high) {
  const double value = json.get<double>();
  if (!(value >= low && value <= high)) throw InvalidInput("a measure is impossible");
  return value;
}

Vec3 point_of(const Json& json) {
  const auto v = json.get<std::array<Json, 3>>();
  return {number_of(v[0], -kLargestMm, kLargestMm), number_of(v[1], -kLargestMm, kLargestMm),
          number_of(v[2], -kLargestMm, kLargestMm)};
}

std::vector<Vec3> points_of(const Json& json) {
  std::vector<Vec3> points;
  for (const Json& p : json) points.push_back(point_of(p));
  if (points.empty()) throw InvalidInput("has no points");
  return points;
}

BoneId bone_named(const Json& json) {
  const auto named = bone_of(json.get<std::string>());
  if (!named || named->part != BonePart::Whole) {
    throw InvalidInput("there is no bone '" + json.get<std::string>() + "'");
  }
  return named->bone;
}

Range range_of(const Json& json) {
  const auto v = json.get<std::array<Json, 2>>();
  const double low = number_of(v[0], 0, kLargestMm);
  return {low, number_of(v[1], low, kLargestMm)};
}

Thickness thickness_of(const Json& json) {
  refuse_unknown(json, {"value", "range", "mark"});
  require_mark(json);
  const Thickness t{number_of(json.at("value"), 0.05, 10), range_of(json.at("range"))};
  if (t.mm < t.range.low || t.mm > t.range.high) throw InvalidInput("a value is out of its range");
  return t;
}

double marked_number(const Json& json) {
  refuse_unknown(json, {"value", "mark"});
  require_mark(json);
  return number_of(json.at("value"), 0, kStiffest);
}

void require_before(const std::string& id, const TissueTable& before) {
  const bool is_known = std::any_of(before.ligaments.begin(), before.ligaments.end(),
                                    [&](const TabledLigament& l) { return l.id == id; });
  if (!is_known) throw InvalidInput("no ligament '" + id + "' comes before it");
}

TabledAttachment attachment_of(const Json& json, const TissueTable& before) {
  TabledAttachment a;
  require_mark(json);
  if (json.contains("ligament")) {
    refuse_unknown(json, {"ligament", "fraction", "half_width_mm", "mark"});
    a.ligament = json.at("ligament").get<std::string>();
    require_before(a.ligament, before);
    a.fraction = number_of(json.at("fraction"), 0, 1);
    a.half_width_mm = number_of(json.at("half_width_mm"), 0.1, 20);
    return a;
  }
  refuse_unknown(json, {"bone", "point_mm", "half_width_mm", "along", "across_mm", "via", "mark"});
  a.bone = bone_named(json.at("bone"));
  a.is_via = json.value("via", false);
  if (json.contains("across_mm")) {
    if (json.contains("point_mm")) throw InvalidInput("give point_mm or across_mm, not both");
    a.across = points_of(json.at("across_mm"));
    if (a.across.size() < 2) throw InvalidInput("across_mm needs two points or more");
    return a;
  }
  a.across = {point_of(json.at("point_mm"))};
  a.half_width_mm = number_of(json.at("half_width_mm"), 0.1, 20);
  if (json.contains("along")) a.along = normalized_or(point_of(json.at("along")), {0, 1, 0});
  return a;
}

TabledLigament ligament_of(const Json& json, const TissueTable& before) {
  refuse_unknown(json, {"id", "name", "group", "side", "strands", "length_mm", "thickness_mm",
                        "stiffness_n_per_mm", "strength_n", "over", "over_mark", "attachments"});
  TabledLigament l;
  l.id = json.at("id").get<std::string>();
  l.name = json.at("name").get<std::string>();
  l.group = json.at("group").get<std::string>();
  const auto side = std::find(kAspects.begin(), kAspects.end(), json.at("side").get<std::string>());
  if (side == kAspects.end()) throw InvalidInput("side is dorsal, volar or proximal");
  l.aspect = static_cast<Aspect>(side - kAspects.begin());
  l.strands = json.at("strands").get<std::size_t>();
  if (l.strands < 2 || l.strands > kMostStrands) throw InvalidInput("has 2 to 16 strands");
  const Json& length = json.at("length_mm");
  refuse_unknown(length, {"range", "mark"});
  require_mark(length);
  l.length_mm = range_of(length.at("range"));
  l.thickness = thickness_of(json.at("thickness_mm"));
  l.stiffness_n_per_mm = marked_number(json.at("stiffness_n_per_mm"));
  if (json.contains("strength_n")) l.strength_n = marked_number(json.at("strength_n"));
  if (json.contains("over")) {
    require_mark(json, "over_mark");
    l.over = json.at("over").get<std::vector<std::string>>();
    for (const std::string& id : l.over) require_before(id, before);
  }
  for (const Json& a : json.at("attachments")) {
    l.attachments.push_back(attachment_of(a, before));
  }
  if (l.attachments.size() < 2 || l.attachments.front().is_via || l.attachments.back().is_via) {
    throw InvalidInput("has an attachment at each end");
  }
  return l;
}

TabledCartilage cartilage_of(const Json& json) {
  refuse_unknown(
      json, {"farthest_mm", "least_area_mm2", "postures_deg", "postures_mark", "default", "bones"});
  require_mark(json, "postures_mark");
  TabledCartilage c;
  c.farthest_mm = number_of(json.at("farthest_mm"), 0.5, 10);
  c.least_area_mm2 = number_of(json.at("least_area_mm2"), 0, 1000);
  for (const Json& p : json.at("postures_deg")) {
    const auto v = p.get<std::array<Json, 2>>();
    c.postures.push_back({number_of(v[0], -90, 90), number_of(v[1], -90, 90)});
  }
  c.of_bone.fill(thickness_of(json.at("default")));
  for (const auto& [name, thickness] : json.at("bones").items()) {
    c.of_bone[static_cast<std::size_t>(bone_named(name)) - 1] = thickness_of(thickness);
  }
  return c;
}

TabledSpace::Body body_of(const Json& json, const TissueTable& table) {
  TabledSpace::Body body;
  for (const Json& part : json) {
    const auto name = part.get<std::string>();
    const bool is_ligament =
        std::any_of(table.ligaments.begin(), table.ligaments.end(),
                    [&](const TabledLigament& l) { return l.id.starts_with(name + "_"); });
    if (name == "disc") {
      body.has_disc = true;
    } else if (is_ligament) {
      body.ligaments.push_back(name + "_");
    } else {
      body.bones.push_back(bone_named(part));
    }
  }
  if (body.bones.empty()) throw InvalidInput("each body needs a bone");
  return body;
}

std::array<TabledSpace::Body, 2> bodies_of(const Json& json, const TissueTable& table) {
  const auto two = json.get<std::array<Json, 2>>();
  return {body_of(two[0], table), body_of(two[1], table)};
}

TabledSpace space_of(const Json& json, const TissueTable& table) {
  refuse_unknown(json, {"id", "name", "between", "nearer", "near_disc_mm", "disc_side"});
  TabledSpace space;
  space.id = json.at("id").get<std::string>();
  space.name = json.at("name").get<std::string>();
  space.between = bodies_of(json.at("between"), table);
  for (const Json& two : json.at("nearer")) space.nearer.push_back(bodies_of(two, table));
  space.near_disc_mm = number_of(json.value("near_disc_mm", Json(0.0)), 0, kLargestMm);
  if (json.contains("disc_side")) {
    const auto side = json.at("disc_side").get<std::string>();
    if (side != "distal" && side != "proximal") {
      throw InvalidInput("disc_side is distal or proximal");
    }
    space.disc_side = side == "distal" ? DiscSide::Distal : DiscSide::Proximal;
  }
  return space;
}

void read_rest(const Json& json, TissueTable& table) {
  const Json& disc = json.at("disc");
  refuse_unknown(disc, {"rim_on_radius_mm", "ulnar_edge_mm", "thickness_mm", "mark"});
  require_mark(disc);
  table.disc = {points_of(disc.at("rim_on_radius_mm")), points_of(disc.at("ulnar_edge_mm")),
                thickness_of(disc.at("thickness_mm"))};
  const Json& recess = json.at("prestyloid_recess");
  refuse_unknown(recess, {"bone", "from_mm", "to_mm", "radius_mm", "space", "mark"});
  require_mark(recess);
  table.recess = {bone_named(recess.at("bone")), point_of(recess.at("from_mm")),
                  point_of(recess.at("to_mm")), number_of(recess.at("radius_mm"), 0.1, 10),
                  recess.at("space").get<std::string>()};
  table.cartilage = cartilage_of(json.at("cartilage"));
}

}  // namespace

std::string_view name_of(Aspect aspect) noexcept {
  return kAspects[static_cast<std::size_t>(aspect) % kAspects.size()];
}

TissueTable TissueTable::parse(std::string_view json_text) {
  std::string where = "the table";
  try {
    const Json json = Json::parse(json_text);
    refuse_unknown(json, {"doc", "schema_version", "materials", "ligaments", "disc",
                          "prestyloid_recess", "cartilage", "spaces"});
    if (json.at("schema_version") != 1) throw InvalidInput("another schema_version than 1");
    TissueTable table;
    std::set<std::string> ids;
    const auto enter = [&](const Json& entry) {
      where = entry.at("id").get<std::string>();
      if (!ids.insert(where).second) throw InvalidInput("is there twice");
    };
    for (const Json& m : json.at("materials")) {
      refuse_unknown(m, {"id", "name", "colour", "mark"});
      table.materials.push_back({m.at("id").get<std::string>(), m.at("name").get<std::string>(),
                                 m.at("colour").get<std::array<double, 3>>()});
    }
    for (const Json& l : json.at("ligaments")) {
      enter(l);
      table.ligaments.push_back(ligament_of(l, table));
    }
    where = "disc, recess and cartilage";
    read_rest(json, table);
    where = "spaces";
    const Json& spaces = json.at("spaces");
    refuse_unknown(spaces, {"closing_radius_mm", "voxel_mm", "mark", "list"});
    require_mark(spaces);
    table.closing_radius_mm = number_of(spaces.at("closing_radius_mm"), 1, 10);
    table.voxel_mm = number_of(spaces.at("voxel_mm"), 0.2, 1);
    for (const Json& s : spaces.at("list")) {
      enter(s);
      table.spaces.push_back(space_of(s, table));
    }
    return table;
  } catch (const Json::exception& error) {
    throw InvalidInput("soft tissue: " + where + ": " + error.what());
  } catch (const InvalidInput& error) {
    throw InvalidInput("soft tissue: " + where + ": " + error.what());
  }
}

const TissueTable& TissueTable::generic() {
  static const TissueTable table = parse(data::soft_tissue());
  return table;
}

}  // namespace carpus::soft_tissue
