// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/shown_by_portals.hpp"

#include "arthroscopy/opened_space.hpp"
#include "cases/joint_under_block.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr double kTractionN = 69;  // the most that is used [S79]
constexpr double kScopeMm = 1.05;  // radius of a 1.9 mm scope, and a little
constexpr double kBehindMm = 0.6;  // of the wall: so far its grid is off
constexpr double kStepMm = 0.5;
constexpr double kShortMm = 0.8;       // before the place: it lies on the wall itself
constexpr double kLeastCosine = 0.57;  // off the shaft a 30 degree scope sees as far as this
constexpr double kShaftMm = 12.0;
constexpr double kNearMm = 2.5;
constexpr double kFarMm = 12.0;

}  // namespace

ShownByPortals::ShownByPortals(const cases::CaseData& data, const cases::ArthroscopicMap& map)
    : data_(data), map_(map) {
  anatomy::HandPose pulled;
  pulled.traction_n = kTractionN;
  for (const cases::Bone& bone : data.bones) {
    poses_.push_back(cases::pose_under_block(data.hand_motion, bone.bone, pulled));
    inverses_.push_back(poses_.back().inverse());
  }
}

bool ShownByPortals::has_room(std::uint8_t joint, const Vec3& at, double room_mm) const {
  const cases::JointSpace& space = map_.joints[joint];
  const OpenedSpace wall =
      opened_space_at(space.wall, inverses_[space.proximal], inverses_[space.distal], at);
  const double behind_mm = room_mm > 0 ? 0.0 : kBehindMm;  // a lens lies before the wall
  return wall.is_near && wall.distance_mm <= behind_mm && !is_in_bone(at, room_mm);
}

bool ShownByPortals::is_in_bone(const Vec3& at, double room_mm) const {
  for (std::size_t b = 0; b < data_.bones.size(); ++b) {
    const cases::Bone& bone = data_.bones[b];
    const bool bounds_joint = bone.bone <= BoneId::Hamate && bone.bone != BoneId::Pisiform;
    if (!bounds_joint || bone.distance_field.values().empty()) continue;
    const Vec3 local = (inverses_[b] * Point<frame::Patient>{at}).v;
    const auto s = fields::sample_distance(bone.distance_field, local);
    if (s.is_inside_grid && s.distance_mm < room_mm) return true;
  }
  return false;
}

/// The shaft behind the tip.
bool ShownByPortals::goes_in(const Vec3& eye, const Vec3& skin) const {
  const Vec3 way = normalized_or(skin - eye, {});
  for (double s = 0; s < kShaftMm; s += 1.0) {
    if (is_in_bone(eye + way * s, kScopeMm)) return false;
  }
  return true;
}

bool ShownByPortals::is_free(std::uint8_t joint, const Vec3& eye, const Vec3& to) const {
  const double far = distance(eye, to);
  for (double s = kStepMm; s < far - kShortMm; s += kStepMm) {
    if (!has_room(joint, eye + (to - eye) * (s / far), 0.0)) return false;
  }
  return true;
}

bool ShownByPortals::shows(std::uint8_t joint, std::uint8_t body, const Vec3& at) const {
  const Vec3 place = (poses_[body] * Point<frame::Bone>{at}).v;
  for (const cases::Portal& portal : map_.portals) {
    if (portal.joint != joint || !portal.is_usual) continue;
    const Vec3 skin = (poses_[portal.body] * Point<frame::Bone>{portal.skin}).v;
    const Vec3 inwards = (poses_[portal.body] * Direction<frame::Bone>{portal.inwards}).v;
    const Vec3 across = normalized_or(cross(inwards, map_.distal), {1, 0, 0});
    for (const double deep : {1.0, 3.0, 5.0, 7.0, 9.0, 12.0}) {
      for (const double aside : {0.0, -2.0, 2.0, -4.0, 4.0, -6.0, 6.0}) {
        for (const double up : {-1.0, 0.0, 1.0, 2.0}) {
          const Vec3 eye =
              skin + inwards * (portal.capsule_mm + deep) + across * aside + map_.distal * up;
          const double far = distance(eye, place);
          if (far < kNearMm || far > kFarMm || !has_room(joint, eye, kScopeMm)) continue;
          const double ahead = dot(normalized_or(eye - skin, inwards), place - eye);
          if (ahead < kLeastCosine * far) continue;
          if (goes_in(eye, skin) && is_free(joint, eye, place)) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace carpus::arthroscopy
