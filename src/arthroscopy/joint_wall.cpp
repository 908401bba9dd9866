// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/joint_wall.hpp"

#include <algorithm>
#include <array>

#include "arthroscopy/portal_table.hpp"
#include "cases/joint_under_block.hpp"
#include "fields/distance_field.hpp"
#include "geometry/aabb.hpp"
#include "mesh/simplify_in_states.hpp"

namespace carpus::arthroscopy {
namespace {

using soft_tissue::Lining;

/// A wall vertex belongs to a ligament whose strand is so near.
constexpr double kStrandMm = 3.0;
constexpr double kFarMm = 4.0;
/// With a probe's 672 and a loose body's 720 less than 15 000 triangles are drawn.
constexpr std::size_t kMostFacets = 13500;
/// So far scaphoid and triquetrum may part from the lunate: Geissler IV, a scope passes [E].
constexpr double kPartedMm = 3.2;

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

using BodyMotion = Pose<frame::Patient, frame::Bone>;

/// The wall's vertices where these motions of the case's bones lay them, as a page does.
std::vector<Vec3> laid(const JointWall& wall, const std::vector<BodyMotion>& motions) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < wall.surface.vertices.size(); ++i) {
    const Point<frame::Bone> at{wall.surface.vertices[i]};
    const Vec3 proximal = (motions[wall.proximal[i]] * at).v;
    const Vec3 distal = (motions[wall.distal[i]] * at).v;
    places.push_back(proximal + (distal - proximal) * static_cast<double>(wall.distal_share[i]));
  }
  return places;
}

/// As scanned, pulled at most, and so with the proximal row's bones apart as torn ligaments let
/// them.
std::array<std::vector<Vec3>, 3> states_of(const cases::CaseData& data, const JointWall& wall) {
  anatomy::HandPose pulled = data.hand_motion.scan;
  pulled.traction_n = PortalTable::generic().traction_n;
  std::vector<BodyMotion> opened;
  std::vector<BodyMotion> parted;
  const cases::Bone* lunate = cases::find_bone(data, BoneId::Lunate, BonePart::Whole);
  for (const cases::Bone& bone : data.bones) {
    opened.push_back(cases::pose_under_block(data.hand_motion, bone.bone, pulled));
    parted.push_back(opened.back());
    if (lunate == nullptr || bone.bone == BoneId::Lunate) continue;
    if (row_of(bone.bone) != Row::Proximal) continue;
    const Vec3 away =
        bounds_of(bone.surface.vertices).centre() - bounds_of(lunate->surface.vertices).centre();
    parted.back().translation += normalized_or(away, {}) * kPartedMm;
  }
  return {wall.surface.vertices, laid(wall, opened), laid(wall, parted)};
}

template <typename T>
void keep_only(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  std::vector<T> left;
  for (const std::uint32_t v : kept) left.push_back(values[v]);
  values = std::move(left);
}

/// So few facets as are drawn in time. What is flat in the scan may be drawn out when the joint
/// opens: simplified by its scanned shape alone the wall stood before the scope in spikes.
void simplify(JointWall& wall, const cases::CaseData& data) {
  const auto states = states_of(data, wall);
  mesh::InStates fewer = mesh::simplify_in_states(wall.surface.facets, states, kMostFacets);
  wall.surface.facets = std::move(fewer.facets);
  wall.simplified_by_mm = fewer.error_mm;
  keep_only(wall.surface.vertices, fewer.kept);
  keep_only(wall.lining, fewer.kept);
  keep_only(wall.fibre, fewer.kept);
  keep_only(wall.proximal, fewer.kept);
  keep_only(wall.distal, fewer.kept);
  keep_only(wall.distal_share, fewer.kept);
}

}  // namespace

std::vector<JointWall> make_joint_walls(const cases::CaseData& data,
                                        const soft_tissue::SoftTissue& tissue) {
  std::vector<JointWall> walls;
  for (const TabledJoint& joint : PortalTable::generic().joints) {
    for (const soft_tissue::Space& space : tissue.spaces) {
      if (space.id == joint.id && !space.surface.facets.empty()) {
        walls.push_back(wall_of(data, tissue, space, joint));
        simplify(walls.back(), data);
      }
    }
  }
  return walls;
}

}  // namespace carpus::arthroscopy
