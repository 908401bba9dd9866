// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/portal_table.hpp"

#include <nlohmann/json.hpp>

#include "cases/arthroscopic_map.hpp"
#include "core/error.hpp"

namespace carpus::data {
std::string_view portals();
}

namespace carpus::arthroscopy {
namespace {

using Json = nlohmann::json;

TabledPortal portal_from(const Json& json) {
  TabledPortal p;
  p.id = json.at("id");
  p.name = json.at("name");
  p.joint = json.at("joint");
  p.landmarks = json.at("landmarks");
  p.from = json.at("from");
  p.distal_mm = json.at("distal_mm");
  p.ulnar_mm = json.at("ulnar_mm");
  p.proximal_deg = json.at("proximal_deg").get<std::array<double, 2>>();
  p.search_mm = json.at("search_mm").get<std::array<double, 2>>();
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
  if (json.contains("on")) {
    const auto bone = bone_of(json.at("on").get<std::string>());
    if (!bone) throw InvalidInput("portals.json: " + p.id + ": there is no such bone");
    p.on = bone->bone;
    const auto at = json.at("at_mm").get<std::array<double, 3>>();
    p.at = {at[0], at[1], at[2]};
  }
  if (!p.ligament.empty()) p.fraction = json.at("fraction");
  if (static_cast<int>(p.on.has_value()) + static_cast<int>(!p.ligament.empty()) +
          static_cast<int>(p.is_disc) !=
      1) {
    throw InvalidInput("portals.json: " + p.id + ": lies on a bone, a ligament or the disc");
  }
  return p;
}

}  // namespace

PortalTable PortalTable::parse(std::string_view json_text) {
  PortalTable table;
  try {
    const Json json = Json::parse(json_text);
    table.traction_n = json.at("traction_n").at("value");
    for (const Json& each : json.at("portals")) table.portals.push_back(portal_from(each));
    for (const Json& each : json.at("points")) table.points.push_back(point_from(each));
  } catch (const Json::exception& error) {
    throw InvalidInput(std::string("portals.json: ") + error.what());
  }
  if (table.portals.size() > cases::kMaxPortals || table.points.size() > cases::kMaxTourPoints) {
    throw InvalidInput("portals.json: too many portals or points");
  }
  return table;
}

const PortalTable& PortalTable::generic() {
  static const PortalTable kTable = parse(data::portals());
  return kTable;
}

}  // namespace carpus::arthroscopy
