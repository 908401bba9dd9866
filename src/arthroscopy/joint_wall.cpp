// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/joint_wall.hpp"

#include <algorithm>

#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using soft_tissue::Lining;

constexpr const char* kJoint = "radiocarpal";
/// A wall vertex belongs to a ligament whose strand is so near.
constexpr double kStrandMm = 3.0;
constexpr double kFarMm = 4.0;

struct Nearest {
  std::uint8_t body = 0;
  double mm = kFarMm;
};

Nearest nearest_of(const cases::CaseData& data, const Vec3& at, bool of_forearm) {
  Nearest best;
  bool has_any = false;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    const cases::Bone& bone = data.bones[b];
    const bool is_row = bone.bone == BoneId::Scaphoid || bone.bone == BoneId::Lunate ||
                        bone.bone == BoneId::Triquetrum;
    if (of_forearm ? bone.bone != BoneId::Radius : !is_row) continue;
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

JointWall make_joint_wall(const cases::CaseData& data, const soft_tissue::SoftTissue& tissue) {
  JointWall wall;
  for (const soft_tissue::Space& space : tissue.spaces) {
    if (space.id != kJoint) continue;
    wall.surface = space.surface;
    wall.lining = space.lining;
  }
  for (std::size_t i = 0; i < wall.surface.vertices.size(); ++i) {
    const Vec3& at = wall.surface.vertices[i];
    const Nearest forearm = nearest_of(data, at, true);
    const Nearest row = nearest_of(data, at, false);
    const bool is_disc = wall.lining[i] == Lining::Disc;
    const double both = forearm.mm + row.mm;
    wall.proximal.push_back(forearm.body);
    wall.distal.push_back(row.body);
    wall.distal_share.push_back(
        static_cast<float>(is_disc ? 0.0 : (both > 0 ? forearm.mm / both : 0.5)));
    wall.fibre.push_back(wall.lining[i] == Lining::Ligament ? fibre_at(tissue, at) : Vec3{});
  }
  return wall;
}

}  // namespace carpus::arthroscopy
