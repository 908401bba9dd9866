// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Mark by the table from a landmark or an earlier portal -> the best way in near there, under
// traction -> as scanned: depth of the capsule, skin, what lies beside.
#include "arthroscopy/detail/portal_placement.hpp"

#include <algorithm>
#include <cstddef>

#include "anatomy/structure_table.hpp"
#include "arthroscopy/detail/joint_of.hpp"
#include "arthroscopy/detail/scanned_bones.hpp"
#include "arthroscopy/detail/way_to_skin.hpp"
#include "arthroscopy/make_map.hpp"
#include "cases/find_structure.hpp"
#include "geometry/pose.hpp"

namespace carpus::arthroscopy::detail {
namespace {

/// Skin over the dorsal capsule where the case has no skin [E].
constexpr double kSkinOverCapsuleMm = 8.0;

std::string millimetres(double mm) { return std::to_string(mm).substr(0, 4) + " mm"; }

}  // namespace

void PortalPlacement::place_all(const PortalTable& table) {
  if (marks_.empty()) {
    map_.problems.emplace_back("there is no radius to feel Lister's tubercle on");
    return;
  }
  for (const TabledPortal& portal : table.portals) {
    const auto mark = std::find_if(marks_.begin(), marks_.end(),
                                   [&](const Landmark& m) { return m.id == portal.from; });
    if (mark == marks_.end()) {
      map_.problems.push_back(portal.name + ": " + portal.from + " was not found");
      continue;
    }
    const auto joint = joint_of(map_, portal.joint);
    if (!joint) continue;  // named already
    if (const auto lacking = cases::lacking(data_.structures, portal.needs); !lacking.empty()) {
      map_.problems.push_back(portal.name + ": not offered, for the case lacks: " + lacking);
      continue;
    }
    const Vec3 nominal = mark->at + Vec3{-portal.distal_mm, portal.ulnar_mm, portal.volar_mm};
    if (const std::optional<Vec3> at = place(table, portal, *joint, nominal)) {
      marks_.push_back({portal.id, *at});
    }
  }
}

std::optional<Vec3> PortalPlacement::under_traction(const PortalTable& table,
                                                    const std::string& id) const {
  for (const TabledPoint& point : table.points) {
    const auto joint = joint_of(map_, point.joint);
    if (point.id != id || !joint) continue;
    const std::optional<Vec3> at = places_.place_of(point, *joint);
    if (!at) return std::nullopt;
    return (bones_.inverse(nearest_body(data_, *at)).inverse() * Point<frame::Bone>{*at}).v;
  }
  return std::nullopt;
}

std::optional<Vec3> PortalPlacement::place(const PortalTable& table,
                                           const TabledPortal& portal,
                                           std::uint8_t in,
                                           const Vec3& nominal) {
  const std::optional<TriedWay> best =
      search_.best_way(portal, map_.joints[in], nominal, under_traction(table, portal.ahead));
  if (!best || !best->has_room()) {
    map_.problems.push_back(portal.name +
                            ": no room between the bones, apart from the other portals" +
                            (best ? " (" + millimetres(best->way.room_mm) + ")" : std::string()));
    return std::nullopt;
  }
  cases::Portal placed = portal_by(portal, in, best->way);
  placed.number = static_cast<std::uint8_t>(&portal - table.portals.data());
  if (!best->is_apart) {
    map_.problems.push_back(portal.name + ": its hole lies beside another portal's");
  }
  if (!best->is_between) {
    map_.problems.push_back(portal.name + ": no room in its interval between tendons");
  }
  say_what_is_cut(placed);
  map_.portals.push_back(placed);
  search_.take(best->way);
  return best->mark;
}

cases::Portal PortalPlacement::portal_by(const TabledPortal& portal,
                                         std::uint8_t in,
                                         const WayIn& way) const {
  cases::Portal placed;
  placed.id = portal.id;
  placed.name = portal.name;
  placed.landmarks = portal.landmarks;
  placed.is_usual = portal.is_usual;
  placed.joint = in;
  placed.body =
      map_.joints[in].proximal;  // which carries it from where it was found under traction
  const auto& as_scanned = bones_.inverse(placed.body);
  const Vec3 capsule = (as_scanned * Point<frame::Patient>{way.capsule}).v;
  placed.inwards = (as_scanned * Direction<frame::Patient>{way.inwards}).v;
  placed.capsule_mm =
      way_to_skin(data_.skin, capsule, -placed.inwards).value_or(kSkinOverCapsuleMm);
  placed.skin = capsule - placed.inwards * placed.capsule_mm;
  placed.room_mm = way.room_mm;
  for (std::size_t kind = 0; kind < placed.beside.size(); ++kind) {
    placed.beside[kind] =
        bones_.beside(static_cast<anatomy::StructureKind>(kind), way.capsule, way.inwards);
  }
  return placed;
}

void PortalPlacement::say_what_is_cut(const cases::Portal& portal) {
  for (const auto& beside : portal.beside) {
    if (!beside || beside->mm >= kLeastRoomMm) continue;
    map_.problems.push_back(portal.name + ": a scope on its way reaches " +
                            millimetres(kLeastRoomMm - beside->mm) + " into the " +
                            data_.structures[beside->structure].name);
  }
}

}  // namespace carpus::arthroscopy::detail
