// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/model_shapes.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "core/units.hpp"

namespace carpus::anatomy {
namespace {

constexpr double kLatticeMm = 0.7;

std::size_t index_of(BoneId bone) { return static_cast<std::size_t>(bone) - 1; }

/// Lattice points inside one bone.
std::vector<Vec3> points_inside(const WristModel& model, const ModelBone& bone) {
  std::vector<Vec3> points;
  const Aabb& box = bone.bounds;
  for (double z = box.low.z; z <= box.high.z; z += kLatticeMm) {
    for (double y = box.low.y; y <= box.high.y; y += kLatticeMm) {
      for (double x = box.low.x; x <= box.high.x; x += kLatticeMm) {
        if (model.signed_value(bone.bone, {x, y, z}) < 0) points.push_back({x, y, z});
      }
    }
  }
  return points;
}

/// The points within the joint end's length of the end that lies farthest from the cut.
std::vector<Vec3> joint_end_of(const std::vector<Vec3>& points, const Plane& cut) {
  Vec3 face_centre, centre;
  double face_count = 0;
  for (const Vec3& p : points) {
    centre += p;
    if (cut.signed_distance(p) > -kLatticeMm) {
      face_centre += p;
      face_count += 1;
    }
  }
  CARPUS_CHECK(face_count > 0);
  const Vec3 towards_joint = normalized_or(
      centre / static_cast<double>(points.size()) - face_centre / face_count, -cut.normal);
  double reach = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) reach = std::max(reach, dot(towards_joint, p));
  std::vector<Vec3> end;
  for (const Vec3& p : points) {
    if (dot(towards_joint, p) > reach - kJointEndLength) end.push_back(p);
  }
  return end;
}

BodyShape measure_bone(const WristModel& model, const ModelBone& bone) {
  BodyShape shape;
  shape.piece_mm3 = kLatticeMm * kLatticeMm * kLatticeMm;
  shape.bounds = bone.bounds;
  shape.is_cut = bone.cut_plane.has_value();
  const std::vector<Vec3> all = points_inside(model, bone);
  const std::vector<Vec3> measured = shape.is_cut ? joint_end_of(all, *bone.cut_plane) : all;
  for (const Vec3& p : measured) shape.moments.add(p);
  summarise(shape);
  return shape;
}

/// Turned about a pivot by half of the given angles, the other half being another joint's.
Vec3 half_turned(const Vec3& p, const Vec3& pivot, const Mat3& half_rotation) {
  return pivot + half_rotation * (p - pivot);
}

}  // namespace

ModelShapes measure_model(const WristModel& model) {
  ModelShapes shapes;
  parallel_for(kBoneCount, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) shapes[i] = measure_bone(model, model.bones()[i]);
  });
  return shapes;
}

const ModelShapes& generic_model_shapes(Side side) {
  static const ModelShapes kLeft = measure_model(WristModel::generic(Side::Left));
  static const ModelShapes kRight = measure_model(WristModel::generic(Side::Right));
  return side == Side::Left ? kLeft : kRight;
}

std::vector<BonePlaces> places_in_postures(const ModelShapes& shapes, Side side) {
  const auto at = [&](BoneId bone) { return shapes[index_of(bone)].centroid; };
  // The wrist turns about the head of the capitate; its two joints lie on either side of the
  // lunate.
  const Vec3 radiocarpal = 0.5 * at(BoneId::Lunate);  // between it and the origin on the radius
  const Vec3 midcarpal = 0.5 * (at(BoneId::Lunate) + at(BoneId::Capitate));
  // The same deviation turns the mirrored hand the other way about z; flexion is about y alike.
  const double mirror = side == Side::Left ? 1 : -1;
  std::vector<BonePlaces> postures;
  for (int flexion_deg = -70; flexion_deg <= 30; flexion_deg += 20) {
    for (int deviation_deg = -15; deviation_deg <= 25; deviation_deg += 20) {
      const Mat3 half =
          rotation_about({0, 0, 1}, mirror * radians_from_degrees(deviation_deg) / 2) *
          rotation_about({0, 1, 0}, radians_from_degrees(flexion_deg) / 2);
      BonePlaces places;
      for (const BoneId bone : kAllBones) {
        Vec3 p = at(bone);
        const bool proximal_row = bone == BoneId::Scaphoid || bone == BoneId::Lunate ||
                                  bone == BoneId::Triquetrum || bone == BoneId::Pisiform;
        if (!belongs_to_forearm(bone)) {
          if (!proximal_row) p = half_turned(p, midcarpal, half);
          p = half_turned(p, radiocarpal, half);
        }
        places[index_of(bone)] = p;
      }
      postures.push_back(places);
    }
  }
  return postures;
}

}  // namespace carpus::anatomy
