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

/// Measures the joint end: what lies within 17 mm of the tip, and how it grows with length.
void measure_joint_end(const std::vector<Vec3>& points, const Plane& cut, BodyShape& shape) {
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
  face_centre = face_centre / face_count;
  const Vec3 towards_joint =
      normalized_or(centre / static_cast<double>(points.size()) - face_centre, -cut.normal);
  double reach = -std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) reach = std::max(reach, dot(towards_joint, p));
  for (const Vec3& p : points) {
    if (dot(towards_joint, p) > reach - kJointEndLength) shape.moments.add(p);
  }
  const double available = std::min(kJointEndLength, reach - dot(towards_joint, face_centre));
  shape.ends.emplace_back(points, towards_joint, available, shape.piece_mm3);
}

BodyShape measure_bone(const WristModel& model, const ModelBone& bone) {
  BodyShape shape;
  shape.piece_mm3 = kLatticeMm * kLatticeMm * kLatticeMm;
  shape.bounds = bone.bounds;
  shape.is_cut = bone.cut_plane.has_value();
  const std::vector<Vec3> all = points_inside(model, bone);
  if (shape.is_cut) {
    measure_joint_end(all, *bone.cut_plane, shape);
  } else {
    for (const Vec3& p : all) shape.moments.add(p);
  }
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

Posture::Posture(const ModelShapes& shapes, const Mat3& half_turn) : half_turn_(half_turn) {
  const auto at = [&](BoneId bone) { return shapes[index_of(bone)].centroid; };
  // The wrist turns about the head of the capitate; its two joints lie on either side of the
  // lunate.
  radiocarpal_ = 0.5 * at(BoneId::Lunate);  // between it and the origin on the radius
  midcarpal_ = 0.5 * (at(BoneId::Lunate) + at(BoneId::Capitate));
}

Vec3 Posture::place(BoneId bone, const Vec3& p) const noexcept {
  if (belongs_to_forearm(bone)) return p;
  const bool proximal_row = bone == BoneId::Scaphoid || bone == BoneId::Lunate ||
                            bone == BoneId::Triquetrum || bone == BoneId::Pisiform;
  const Vec3 turned = proximal_row ? p : half_turned(p, midcarpal_, half_turn_);
  return half_turned(turned, radiocarpal_, half_turn_);
}

std::vector<Posture> all_postures(const ModelShapes& shapes, Side side) {
  // The same deviation turns the mirrored hand the other way about z; flexion is about y alike.
  const double mirror = side == Side::Left ? 1 : -1;
  std::vector<Posture> postures;
  for (int flexion_deg = -70; flexion_deg <= 30; flexion_deg += 20) {
    for (int deviation_deg = -15; deviation_deg <= 25; deviation_deg += 20) {
      postures.emplace_back(
          shapes, rotation_about({0, 0, 1}, mirror * radians_from_degrees(deviation_deg) / 2) *
                      rotation_about({0, 1, 0}, radians_from_degrees(flexion_deg) / 2));
    }
  }
  return postures;
}

}  // namespace carpus::anatomy
