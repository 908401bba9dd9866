// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tendons, arteries and nerves of a case as tubes. They are generated from the generic wrist
// (make_structures.hpp), never seen in the CT, and that is said wherever they are shown.
#pragma once

#include <string>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "anatomy/structure_table.hpp"
#include "geometry/vec3.hpp"

namespace carpus::cases {

/// A point of a tube's middle line as scanned, and how far it goes with the hand: 0 with the
/// forearm's bone, 1 with the hand, between them along their blend (geometry/rigid_blend.hpp).
struct StructurePoint {
  Vec3 at;  ///< frame Patient [mm]
  double hand_share = 0;
  bool operator==(const StructurePoint&) const = default;
};

struct Structure {
  std::string id;    ///< as in data/structures.json: "epl"
  std::string name;  ///< as a person says it
  anatomy::StructureKind kind = anatomy::StructureKind::Tendon;
  double radius_mm = 0;
  BoneId forearm = BoneId::Radius;     ///< which the forearm's end goes with
  std::vector<StructurePoint> course;  ///< from proximal to distal
  bool operator==(const Structure&) const = default;
};

/// Most tubes and points a tube that a case may hold: what the tick keeps room for.
inline constexpr std::size_t kMaxStructures = 32;
inline constexpr std::size_t kMaxStructurePoints = 96;

/// Along the middle line [mm].
[[nodiscard]] double length_of(const Structure& structure);

/// The nearest distance of a point from a tube's surface [mm], negative inside.
[[nodiscard]] double distance_to(const Structure& structure, const Vec3& point);

}  // namespace carpus::cases
