// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an arthroscopy of a case goes by: portals, the points of its tour, cartilage to be seen, the
// walls of the joint. Generated with the soft tissue (arthroscopy/make_map.hpp), never seen in a
// CT. Frame Patient as scanned, which is frame Bone of the body that each goes with.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/structure_table.hpp"
#include "cases/ligament_band.hpp"
#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"
#include "geometry/vec3.hpp"

namespace carpus::cases {

/// What lies beside a portal's way.
struct BesideWay {
  std::size_t structure = 0;  ///< its place in CaseData::structures
  double mm = 0;              ///< from the way's middle line to its surface; negative inside
};

/// A way through skin and capsule into a joint.
struct Portal {
  std::string id;  ///< "3-4"
  std::string name;
  std::string landmarks;    ///< in words: how it is found
  std::uint8_t number = 0;  ///< its place in data/portals.json, the same in every case
  bool is_usual = true;     ///< of the tour; others are offered beside it
  std::uint8_t joint = 0;   ///< that it leads into, in ArthroscopicMap::joints
  Vec3 skin;                ///< [mm]
  Vec3 inwards;             ///< unit
  double capsule_mm = 0;    ///< from the skin along `inwards`
  double room_mm = 0;       ///< radius of what goes in there under traction, to its working depth
  std::uint8_t body = 0;    ///< that takes it along, in CaseData::bones
  /// By anatomy::StructureKind the nearest to the way from skin to capsule, under traction.
  std::array<std::optional<BesideWay>, anatomy::kStructureKinds> beside;
};

/// A place of a bone that is felt through the skin.
struct FeltLandmark {
  std::string id;  ///< "lister", "radial_styloid", "ulnar_styloid"
  Vec3 at;         ///< on the bone [mm]
  std::uint8_t body = 0;
};

/// A place of the diagnostic tour.
struct TourPoint {
  int number = 0;  ///< of the 24 of the whole tour
  std::string id;
  std::string name;
  std::string found_by;  ///< what is seen there, one sentence
  Vec3 at;               ///< on the surface that is looked at [mm]
  std::uint8_t body = 0;
  bool is_probed = false;  ///< seen is not enough: the probe is to touch it
  std::uint8_t joint = 0;
  /// From where it is looked at, in ArthroscopicMap::portals, the usual one first.
  std::vector<std::uint8_t> by;
};

/// A piece of a joint's cartilage.
struct CartilageFacet {
  Vec3 at;
  Vec3 normal;  ///< unit, out of the bone
  double area_mm2 = 0;
  std::uint8_t body = 0;
  std::uint8_t joint = 0;
};

/// The space of one joint as scanned.
struct JointSpace {
  std::string id;  ///< "radiocarpal"
  std::string name;
  Grid<float> wall;           ///< signed distance to the wall of the space, negative in it
  std::uint8_t proximal = 0;  ///< body that its proximal wall goes with
  std::uint8_t distal = 0;    ///< ... and its distal one
};

/// Most portals and points of a tour that a case may hold: what the tick keeps room for.
inline constexpr std::size_t kMaxPortals = 16;
inline constexpr std::size_t kMaxJoints = 3;
inline constexpr std::size_t kMaxTourPoints = 32;

struct ArthroscopicMap {
  std::vector<JointSpace> joints;  ///< that a portal leads into; the radiocarpal one first
  std::vector<Portal> portals;
  std::vector<FeltLandmark> landmarks;
  std::vector<TourPoint> points;
  std::vector<CartilageFacet> cartilage;  ///< of these joints
  std::uint8_t forearm = 0;               ///< the radius's body
  TriangleMesh disc;                ///< stands before what lies behind it; goes with the forearm
  TriangleMesh disc_sheet;          ///< its middle, which yields (arthroscopy/disc_net.hpp)
  std::vector<LigamentBand> bands;  ///< ligaments that yield, at most kMaxBands
  Vec3 distal;                      ///< unit: up in a level picture; goes with the forearm
  /// Why there is none, or what of it is missing, in words.
  std::vector<std::string> problems;

  [[nodiscard]] bool is_empty() const noexcept { return portals.empty(); }
};

/// The portal with this id; nullptr where the case has none.
[[nodiscard]] inline const Portal* find_portal(const ArthroscopicMap& map,
                                               const std::string& id) noexcept {
  for (const Portal& portal : map.portals) {
    if (portal.id == id) return &portal;
  }
  return nullptr;
}

}  // namespace carpus::cases
