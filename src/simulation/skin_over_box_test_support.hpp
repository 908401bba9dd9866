// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The box of a joint under a plate of skin, with a tendon and a nerve between them, and what a
// procedure that makes portals into it declares.
#pragma once

#include <memory>
#include <vector>

#include "simulation/box_joint_test_support.hpp"

namespace carpus::simulation::box_joint {

inline constexpr double kCapsuleMm = 6.0;
/// Skin, 6 mm before the joint's wall; out of it is +x.
inline const double kSkinX = kMiddle.x + kHalf + kCapsuleMm;
inline constexpr double kPlateHalf = 60.0;

inline TriangleMesh plate() {
  TriangleMesh mesh;
  for (const double y : {-kPlateHalf, kPlateHalf}) {
    for (const double z : {-kPlateHalf, kPlateHalf}) mesh.vertices.push_back({kSkinX, y, z});
  }
  mesh.facets = {{0, 2, 1}, {1, 2, 3}};
  return mesh;
}

/// A tendon runs 4 mm under the skin, 8 mm aside of the portal, a nerve 3 mm under it, 8 mm the
/// other way.
inline cases::Structure tube(const char* id,
                             anatomy::StructureKind kind,
                             double y,
                             double under_mm) {
  cases::Structure made;
  made.id = id;
  made.name = id;
  made.kind = kind;
  made.radius_mm = 1.0;
  for (double z = -40; z <= 40; z += 4) made.course.push_back({{kSkinX - under_mm, y, z}, 0.0});
  return made;
}

inline const cases::CaseData& wrist_with_skin() {
  static const cases::CaseData data = [] {
    cases::CaseData made = box_wrist();
    static_cast<TriangleMesh&>(made.skin) = plate();
    cases::ArthroscopicMap map = *made.arthroscopy;
    cases::Portal other = map.portals.front();
    other.id = "4-5";
    other.skin.y += 7;
    map.portals.push_back(other);
    map.landmarks.push_back({"lister", {kSkinX - 3, 0, -10}, map.forearm});
    made.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(map);
    made.structures = {tube("tendon", anatomy::StructureKind::Tendon, -8, 4),
                       tube("nerve", anatomy::StructureKind::Nerve, 11, 3)};
    return made;
  }();
  return data;
}

inline procedure::PortalMaking figures() {
  procedure::PortalMaking made;
  made.first = "3-4";
  made.second = {"4-5"};
  made.landmarks = {{"3-4", "lister"}, {"4-5", "3-4"}};
  made.touch_n = 0.3;
  made.bone_mm = 4.5;
  made.deepest_mm = 16;
  made.cord_deep_mm = 10;
  made.skin_mm = 1.5;
  made.fascia_mm = 2.5;
  made.firm_share = 0.5;
  made.cell_mm = 2.5;
  made.cell_s = 0.1;
  made.cells = 5;
  made.ink_mm = 0.8;
  made.pass_mm = 4;
  made.strike_n = 1;
  made.in_joint_s = 0.3;
  made.cut_reach_mm = 1.5;
  made.cut_stretch_mm = 1;
  made.spread_s = 0.4;
  made.spread_reach_mm = 2.5;
  return made;
}

inline InstrumentIndex tool(const char* id) { return *instruments::instrument_of(id); }

inline const procedure::Procedure& making() {
  static const procedure::Procedure kProcedure = [] {
    procedure::Procedure made = probe_alone();
    made.tray.clear();
    for (const char* id : {"fingertip", "skin_marker", "needle_22g", "blade_15", "mosquito_clamp",
                           "scope_sheath_1_9"}) {
      made.tray.push_back(tool(id));
    }
    made.making = figures();
    return made;
  }();
  return kProcedure;
}

}  // namespace carpus::simulation::box_joint
