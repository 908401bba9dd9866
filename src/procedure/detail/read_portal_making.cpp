// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedure/detail/read_portal_making.hpp"

#include <algorithm>

#include "anatomy/structure_table.hpp"

namespace carpus::procedure::detail {
namespace {

constexpr double kMostMm = 20.0;
constexpr double kMostN = 40.0;
constexpr double kMostS = 10.0;

bool is_named(const PortalMaking& making, const std::string& portal) {
  return landmark_of(making, portal) != nullptr;
}

PortalLandmark read_landmark(JsonFields& fields) {
  PortalLandmark read;
  read.portal = fields.text("portal");
  read.landmark = fields.text("felt");
  read.endangers = fields.texts_or_none("endangers");
  read.draws_aside = fields.texts_or_none("draws_aside");
  read.is_opened_first = fields.boolean_or("opened_first", false);
  if (read.is_opened_first) read.before_needle = fields.text("before_needle");
  for (const auto* ids : {&read.endangers, &read.draws_aside}) {
    for (const std::string& id : *ids) {
      if (anatomy::StructureTable::generic().find(id) == nullptr) {
        fields.refuse("there is no structure " + id);
      }
    }
  }
  if (fields.has("judged_mm")) {
    read.judged_mm = fields.number("judged_mm", 0.1, kMostMm);
    read.beyond = fields.text("beyond");
  }
  fields.refuse_unknown_fields();
  return read;
}

void read_palpation(JsonFields fields, PortalMaking& making) {
  making.touch_n = fields.number("touch_n", 0.0, kMostN);
  making.bone_mm = fields.number("bone_mm", 0.0, kMostMm);
  making.deepest_mm = fields.number("deepest_mm", 1.0, kMostMm);
  making.cord_deep_mm = fields.number("cord_deep_mm", 0.0, kMostMm);
  making.cord_mm = fields.number("cord_mm", 0.0, kMostMm);
  making.firm_share = fields.number("firm_share", 0.0, 1.0);
  making.cell_mm = fields.number("cell_mm", 0.1, kMostMm);
  making.cell_s = fields.number("cell_s", 0.0, kMostS);
  making.cells = static_cast<std::uint8_t>(fields.number("cells", 1, kCellsAcross * kCellsAcross));
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
}

void read_tools(JsonFields fields, PortalMaking& making) {
  making.skin_mm = fields.number("skin_mm", 0.0, kMostMm);
  making.fascia_mm = fields.number("fascia_mm", making.skin_mm, kMostMm);
  making.ink_mm = fields.number("ink_mm", 0.1, kMostMm);
  making.pass_mm = fields.number("pass_mm", 0.1, kMostMm);
  making.strike_n = fields.number("strike_n", 0.0, kMostN);
  making.in_joint_s = fields.number("in_joint_s", 0.0, kMostS);
  making.cut_reach_mm = fields.number("cut_reach_mm", 0.0, kMostMm);
  making.cut_stretch_mm = fields.number("cut_stretch_mm", 0.0, kMostMm);
  making.spread_s = fields.number("spread_s", 0.0, kMostS);
  making.spread_reach_mm = fields.number("spread_reach_mm", 0.0, kMostMm);
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
}

}  // namespace

PortalMaking read_portal_making(JsonFields& fields) {
  PortalMaking making;
  making.first = fields.text("first");
  making.second = fields.texts_or_none("second");
  if (making.second.empty()) fields.refuse("second: name at least one portal");
  making.task = fields.text("task");
  if (making.task.find("{second}") == std::string::npos) {
    fields.refuse("task: say which is the second portal, {second}");
  }
  for (JsonFields& each : fields.objects("landmarks")) {
    making.landmarks.push_back(read_landmark(each));
  }
  if (!is_named(making, making.first)) fields.refuse("landmarks: none is said for the first");
  for (const std::string& second : making.second) {
    if (second == making.first) fields.refuse("second: the first is made already");
    if (!is_named(making, second)) fields.refuse("landmarks: none is said for " + second);
  }
  making.needs_structures = fields.boolean_or("needs_structures", false);
  read_palpation(fields.object("palpation"), making);
  read_tools(fields.object("tools"), making);
  (void)fields.text("mark");
  fields.refuse_unknown_fields();
  return making;
}

}  // namespace carpus::procedure::detail
