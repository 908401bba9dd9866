// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What lies between skin and bone at a wrist and can be harmed: tendons, arteries and nerves as
// courses relative to landmarks of the generic wrist's bones (data/structures.json, where every
// figure has its mark). No scan shows them: what is made from this table is generated, and says so.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/vec3.hpp"

namespace carpus::anatomy {

enum class StructureKind : std::uint8_t { Tendon = 0, Artery = 1, Nerve = 2 };
inline constexpr std::size_t kStructureKinds = 3;

/// "tendon", "artery", "nerve".
[[nodiscard]] std::string_view name_of(StructureKind kind) noexcept;
[[nodiscard]] std::optional<StructureKind> structure_kind_of(std::string_view name) noexcept;

/// A point on the surface of a bone of the generic left wrist.
struct Landmark {
  std::string id;
  BoneId bone = BoneId::Radius;
  Vec3 at;  ///< frame Wrist of a left wrist [mm]
};

/// Where a point is held in depth.
enum class Layer : std::uint8_t {
  AsPlaced,   ///< where its offset puts it
  OverBone,   ///< `millimetres` between the bone's surface and the structure's
  UnderSkin,  ///< the structure's middle `millimetres` below the skin
};

/// A place relative to a landmark: axes of the generic left wrist, which turn and grow with the
/// landmark's bone.
struct Place {
  std::size_t landmark = 0;  ///< in StructureTable::landmarks
  Vec3 offset;               ///< frame Wrist of a left wrist: proximal, ulnar, volar [mm]
  Layer layer = Layer::AsPlaced;
  double millimetres = 0;
};

struct TabledStructure {
  std::string id;
  std::string name;  ///< as a person says it
  StructureKind kind = StructureKind::Tendon;
  double radius_mm = 0;
  BoneId forearm = BoneId::Radius;  ///< its forearm's part goes with this bone
  double shortest_mm = 0;           ///< the whole course, size of the generic wrist
  double longest_mm = 0;
  std::string avoid;          ///< how a wire does not harm it, in words
  std::vector<Place> course;  ///< from proximal to distal
};

/// A published distance to compare with.
struct PublishedDistance {
  std::string to;  ///< in words
  double mm = 0;
  std::string mark;
};

/// An arthroscopy portal at the skin.
struct TabledPortal {
  std::string id;
  Place place;
  std::vector<PublishedDistance> published;
};

struct StructureTable {
  std::vector<Landmark> landmarks;
  std::vector<TabledStructure> structures;
  std::vector<TabledPortal> portals;
  /// How who makes an arthroscopy's portal does not harm one, in words; by StructureKind.
  std::array<std::string, kStructureKinds> at_a_portal;

  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const StructureTable& generic();

  /// Reads the format of data/structures.json.
  /// @throws InvalidInput naming what is wrong where the text is no such table.
  [[nodiscard]] static StructureTable parse(std::string_view json_text);

  /// The structure with this id, or nullptr.
  [[nodiscard]] const TabledStructure* find(std::string_view id) const noexcept;
};

}  // namespace carpus::anatomy
