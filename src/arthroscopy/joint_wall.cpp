// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/joint_wall.hpp"

#include <algorithm>

#include "arthroscopy/portal_table.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using soft_tissue::Lining;

/// A wall vertex belongs to a ligament whose strand is so near.
constexpr double kStrandMm = 3.0;
constexpr double kFarMm = 4.0;

struct Nearest {
  std::uint8_t body = 0;
  double mm = kFarMm;
};

enum class Row : std::uint8_t { Forearm, Proximal, Distal };

Row row_of(BoneId bone) {
  switch (bone) {
    case BoneId::Scaphoid:
    case BoneId::Lunate:
    case BoneId::Triquetrum:
      return Row::Proximal;
    default:
      return belongs_to_forearm(bone) ? Row::Forearm : Row::Distal;
  }
}

/// Of the bones on one side; the ulna turns against the forearm, the pisiform bounds no joint here.
bool bounds_joint(BoneId bone) {
  return bone != BoneId::Ulna && bone != BoneId::Pisiform && bone <= BoneId::Hamate;
}

Nearest nearest_of(const cases::CaseData& data, const Vec3& at, Row row) {
  Nearest best;
  bool has_any = false;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    const cases::Bone& bone = data.bones[b];
    if (!bounds_joint(bone.bone) || row_of(bone.bone) != row) continue;
    double mm = kFarMm;
    if (!bone.distance_field.values().empty()) {
      const fields::DistanceSample s = fields::sample_distance(bone.distance_field, at);
      if (s.is_inside_grid) mm = std::max(0.0, s.distance_mm);
    }
    if (has_any && mm >= best.mm) continue;
    best = {static_cast<std::uint8_t>(b), mm};
    has_any = true;
  }
  return best;
}

Vec3 fibre_at(const soft_tissue::SoftTissue& tissue, const Vec3& at) {
  double least = kStrandMm * kStrandMm;
  Vec3 way;
  for (const soft_tissue::Ligament& ligament : tissue.ligaments) {
    for (const soft_tissue::Strand& strand : ligament.strands) {
      for (std::size_t i = 0; i + 1 < strand.course.size(); ++i) {
        const double far = squared_length(strand.course[i] - at);
        if (far >= least) continue;
        least = far;
        way = strand.course[i + 1] - strand.course[i];
      }
    }
  }
  return normalized_or(way, {});
}

}  // namespace

namespace {

JointWall wall_of(const cases::CaseData& data,
                  const soft_tissue::SoftTissue& tissue,
                  const soft_tissue::Space& space,
                  const TabledJoint& joint) {
  JointWall wall;
  wall.joint = joint.id;
  wall.surface = space.surface;
  wall.lining = space.lining;
  for (std::size_t i = 0; i < wall.surface.vertices.size(); ++i) {
    const Vec3& at = wall.surface.vertices[i];
    const Nearest proximal = nearest_of(data, at, row_of(joint.between[0]));
    const Nearest distal = nearest_of(data, at, row_of(joint.between[1]));
    const bool is_disc = wall.lining[i] == Lining::Disc;
    const double both = proximal.mm + distal.mm;
    wall.proximal.push_back(proximal.body);
    wall.distal.push_back(distal.body);
    wall.distal_share.push_back(
        static_cast<float>(is_disc ? 0.0 : (both > 0 ? proximal.mm / both : 0.5)));
    wall.fibre.push_back(wall.lining[i] == Lining::Ligament ? fibre_at(tissue, at) : Vec3{});
  }
  return wall;
}

}  // namespace

std::vector<JointWall> make_joint_walls(const cases::CaseData& data,
                                        const soft_tissue::SoftTissue& tissue) {
  std::vector<JointWall> walls;
  for (const TabledJoint& joint : PortalTable::generic().joints) {
    for (const soft_tissue::Space& space : tissue.spaces) {
      if (space.id == joint.id && !space.surface.facets.empty()) {
        walls.push_back(wall_of(data, tissue, space, joint));
      }
    }
  }
  return walls;
}

}  // namespace carpus::arthroscopy
