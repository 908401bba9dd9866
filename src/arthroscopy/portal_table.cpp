// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/portal_table.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "anatomy/structure_table.hpp"
#include "cases/arthroscopic_map.hpp"
#include "core/error.hpp"

namespace carpus::data {
std::string_view portals();
}

namespace carpus::arthroscopy {
namespace {

using Json = nlohmann::json;

BoneId bone_from(const Json& json, const std::string& where) {
  const auto bone = bone_of(json.get<std::string>());
  if (!bone) throw InvalidInput("portals.json: " + where + ": there is no such bone");
  return bone->bone;
}

std::array<BoneId, 2> bones_from(const Json& json, const std::string& where) {
  if (json.size() != 2) throw InvalidInput("portals.json: " + where + ": lies between two bones");
  return {bone_from(json.at(0), where), bone_from(json.at(1), where)};
}

TabledJoint joint_from(const Json& json) {
  TabledJoint j;
  j.id = json.at("id");
  j.name = json.at("name");
  j.between = bones_from(json.at("between"), j.id);
  return j;
}

TabledPortal portal_from(const Json& json) {
  TabledPortal p;
  p.id = json.at("id");
  p.name = json.at("name");
  p.joint = json.at("joint");
  p.landmarks = json.at("landmarks");
  p.from = json.at("from");
  p.distal_mm = json.at("distal_mm");
  p.ulnar_mm = json.at("ulnar_mm");
  p.volar_mm = json.value("volar_mm", 0.0);
  p.proximal_deg = json.at("proximal_deg").get<std::array<double, 2>>();
  p.ulnar_deg = json.value("ulnar_deg", p.ulnar_deg);
  p.is_usual = json.value("usual", true);
  p.is_narrow = json.value("narrow", false);
  p.between = json.value("interval", p.between);
  p.needs = json.value("needs", p.needs);
  p.search_mm = json.at("search_mm").get<std::array<double, 2>>();
  p.ahead = json.value("ahead", "");
  return p;
}

TabledPoint point_from(const Json& json) {
  TabledPoint p;
  p.number = json.at("number");
  p.id = json.at("id");
  p.name = json.at("name");
  p.found_by = json.at("found_by");
  p.ligament = json.value("ligament", "");
  p.is_disc = json.value("disc", false);
  p.is_probed = json.value("probe", false);
  p.joint = json.at("joint");
  p.by = json.at("by").get<std::vector<std::string>>();
  p.is_place = json.value("place", false);
  if (json.contains("on")) p.on = bone_from(json.at("on"), p.id);
  if (json.contains("between")) p.between = bones_from(json.at("between"), p.id);
  if (p.on || p.between || p.is_place) {
    const auto at = json.at("at_mm").get<std::array<double, 3>>();
    p.at = {at[0], at[1], at[2]};
  }
  if (!p.ligament.empty()) p.fraction = json.at("fraction");
  const int ways = static_cast<int>(p.on.has_value()) + static_cast<int>(p.between.has_value()) +
                   static_cast<int>(!p.ligament.empty()) + static_cast<int>(p.is_disc) +
                   static_cast<int>(p.is_place);
  if (ways != 1) {
    throw InvalidInput("portals.json: " + p.id +
                       ": lies on a bone, between two, on a ligament, the disc or at a place");
  }
  return p;
}

/// What is named exists, and a point's number has its bit.
void check_names(const PortalTable& table) {
  const auto is_joint = [&](const std::string& id) {
    return std::any_of(table.joints.begin(), table.joints.end(),
                       [&](const auto& joint) { return joint.id == id; });
  };
  const auto is_portal = [&](const std::string& id) {
    return std::any_of(table.portals.begin(), table.portals.end(),
                       [&](const auto& portal) { return portal.id == id; });
  };
  const auto is_point = [&](const std::string& id) {
    return std::any_of(table.points.begin(), table.points.end(),
                       [&](const auto& point) { return point.id == id; });
  };
  for (const TabledPortal& portal : table.portals) {
    for (const std::string& id : portal.needs) {
      if (anatomy::StructureTable::generic().find(id) == nullptr) {
        throw InvalidInput("portals.json: " + portal.id + ": there is no structure " + id);
      }
    }
    if (!is_joint(portal.joint)) {
      throw InvalidInput("portals.json: " + portal.id + ": there is no joint " + portal.joint);
    }
    if (!portal.ahead.empty() && !is_point(portal.ahead)) {
      throw InvalidInput("portals.json: " + portal.id + ": there is no point " + portal.ahead);
    }
  }
  for (const TabledPoint& point : table.points) {
    if (!is_joint(point.joint)) {
      throw InvalidInput("portals.json: " + point.id + ": there is no joint " + point.joint);
    }
    if (point.number < 1 || point.number >= static_cast<int>(cases::kMaxTourPoints)) {
      throw InvalidInput("portals.json: " + point.id + ": its number is none of 1 to 31");
    }
    for (const std::string& id : point.by) {
      if (!is_portal(id)) {
        throw InvalidInput("portals.json: " + point.id + ": there is no portal " + id);
      }
    }
  }
}

}  // namespace

PortalTable PortalTable::parse(std::string_view json_text) {
  PortalTable table;
  try {
    const Json json = Json::parse(json_text);
    table.traction_n = json.at("traction_n").at("value");
    for (const Json& each : json.at("joints")) table.joints.push_back(joint_from(each));
    for (const Json& each : json.at("portals")) table.portals.push_back(portal_from(each));
    for (const Json& each : json.at("points")) table.points.push_back(point_from(each));
  } catch (const Json::exception& error) {
    throw InvalidInput(std::string("portals.json: ") + error.what());
  }
  if (table.joints.size() > cases::kMaxJoints || table.portals.size() > cases::kMaxPortals ||
      table.points.size() > cases::kMaxTourPoints) {
    throw InvalidInput("portals.json: too many joints, portals or points");
  }
  check_names(table);
  return table;
}

const PortalTable& PortalTable::generic() {
  static const PortalTable kTable = parse(data::portals());
  return kTable;
}

}  // namespace carpus::arthroscopy
