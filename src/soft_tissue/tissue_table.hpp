// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Soft tissue of the generic wrist as data (data/soft_tissue.json): where ligaments, disc and
// recess attach, how thick tissues are, which bones bound a joint's space. Every figure carries
// its source or mark there.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "geometry/vec3.hpp"

namespace carpus::soft_tissue {

/// From low to high, in the file's unit; of the generic wrist's size.
struct Range {
  double low = 0;
  double high = 0;
};

struct Thickness {
  double mm = 0;
  Range range;
};

struct Material {
  std::string id;
  std::string name;
  std::array<double, 3> colour{};  ///< sRGB, 0 to 1
};

/// A place where a ligament holds: on a bone, or on another ligament's course.
struct TabledAttachment {
  std::optional<BoneId> bone;
  std::string ligament;       ///< where there is no bone
  double fraction = 0;        ///< of that ligament's course from its first attachment
  std::vector<Vec3> across;   ///< one point, or a line from edge to edge; frame Wrist, left [mm]
  double half_width_mm = 0;   ///< of an area given by one point, or on a ligament
  std::optional<Vec3> along;  ///< way of the width; else across the ligament
  bool is_via = false;        ///< touched on the way, not an end
};

/// The side of the bones on which a ligament's course lies.
enum class Aspect { Dorsal, Volar, Proximal };

struct TabledLigament {
  std::string id;
  std::string name;
  std::string group;
  Aspect aspect = Aspect::Dorsal;
  std::size_t strands = 0;
  Range length_mm;
  Thickness thickness;
  double stiffness_n_per_mm = 0;  ///< of the whole ligament
  std::optional<double> strength_n;
  std::vector<TabledAttachment> attachments;  ///< in order along the ligament
  std::vector<std::string> over;              ///< ligaments upon which it lies, where they cross
};

struct TabledDisc {
  std::vector<Vec3> rim;         ///< on the radius, dorsal to volar; frame Wrist, left [mm]
  std::vector<Vec3> ulnar_edge;  ///< over the ulna, dorsal to volar
  Thickness thickness;
};

struct TabledRecess {
  BoneId bone = BoneId::Ulna;
  Vec3 from;
  Vec3 to;
  double radius_mm = 0;
  std::string space;  ///< to which it belongs
};

struct TabledCartilage {
  double farthest_mm = 0;
  double least_area_mm2 = 0;
  /// Flexion and radial deviation in which faces may meet [deg].
  std::vector<std::array<double, 2>> postures;
  std::array<Thickness, kBoneCount> of_bone;  ///< by kAllBones
};

enum class DiscSide { Distal, Proximal };

/// A joint's space lies between two bodies of bones, disc and parts of the proximal row.
struct TabledSpace {
  struct Body {
    std::vector<BoneId> bones;
    bool has_disc = false;
    std::vector<std::string> ligaments;  ///< beginnings of ids: "SL" is all three parts
  };
  std::string id;
  std::string name;
  std::array<Body, 2> between;
  std::vector<std::array<Body, 2>> nearer;  ///< to the first than to the second
  double near_disc_mm = 0;                  ///< ends so far from the disc; 0: anywhere
  /// What lies on the disc belongs to the space on that side of it.
  std::optional<DiscSide> disc_side;
};

struct TissueTable {
  std::vector<Material> materials;
  /// What attaches to another or lies over it comes after it. Where two would share room the
  /// earlier one has it.
  std::vector<TabledLigament> ligaments;
  TabledDisc disc;
  TabledRecess recess;
  TabledCartilage cartilage;
  double closing_radius_mm = 0;
  double voxel_mm = 0;
  std::vector<TabledSpace> spaces;

  /// Reads the format of data/soft_tissue.json.
  /// @throws InvalidInput naming the entry where the text is no such table.
  [[nodiscard]] static TissueTable parse(std::string_view json_text);

  /// The built-in table; parsed at the first call.
  [[nodiscard]] static const TissueTable& generic();
};

[[nodiscard]] std::string_view name_of(Aspect aspect) noexcept;

}  // namespace carpus::soft_tissue
