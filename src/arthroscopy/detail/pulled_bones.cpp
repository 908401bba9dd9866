// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bones stay as scanned: points are taken back into each bone's frame and looked up in its distance
// field. Only tendons, nerves and arteries are laid anew, once.
#include "arthroscopy/detail/pulled_bones.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "arthroscopy/detail/scanned_bones.hpp"
#include "cases/joint_under_block.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy::detail {
namespace {

/// From the capsule outwards: beyond the skin lies nothing.
constexpr double kToOutsideMm = 30.0;
/// Of ways that cut as deep to so much the roomier is taken [E].
constexpr double kCutStepMm = 0.5;
constexpr double kFieldErrorMm = 0.5;  // far more than a distance field is off
constexpr double kRounding = 1e-3;     // of such a step: distances are true to rounding

}  // namespace

PulledBones::PulledBones(const cases::CaseData& data, double traction_n)
    : data_(data), structures_(data) {
  anatomy::HandPose pose = data.hand_motion.scan;
  pose.traction_n = traction_n;
  std::vector<Pose<frame::Patient, frame::Bone>> poses;
  for (const cases::Bone& bone : data.bones) {
    poses.push_back(cases::pose_under_block(data.hand_motion, bone.bone, pose));
    from_patient_.push_back(poses.back().inverse());
    boxes_.push_back(bounds_of(bone.surface.vertices));
  }
  structures_.follow(poses);
}

std::optional<cases::BesideWay> PulledBones::beside(anatomy::StructureKind kind,
                                                    const Vec3& capsule,
                                                    const Vec3& inwards) const {
  std::optional<cases::BesideWay> nearest;
  for (std::size_t i = 0; i < structures_.size(); ++i) {
    if (data_.structures[i].kind != kind) continue;
    const double mm = structures_.gap_mm(i, capsule, capsule - inwards * kToOutsideMm);
    if (!nearest || mm < nearest->mm) nearest = cases::BesideWay{i, mm};
  }
  return nearest;
}

bool PulledBones::is_beyond(const std::string& structure,
                            const Vec3& along,
                            const Vec3& capsule,
                            const Vec3& inwards) const {
  for (std::size_t i = 0; i < structures_.size(); ++i) {
    if (data_.structures[i].id != structure) continue;
    double least = kToOutsideMm;
    double side = 0;
    for (const Vec3& p : structures_.course(i)) {
      const double out = std::clamp(dot(capsule - p, inwards), 0.0, kToOutsideMm);
      const Vec3 off = capsule - inwards * out - p;
      if (length(off) >= least) continue;
      least = length(off);
      side = dot(off, along);
    }
    return side >= 0;
  }
  return true;
}

double PulledBones::cut_mm(std::span<const anatomy::StructureKind> kinds,
                           double clear_mm,
                           const Vec3& capsule,
                           const Vec3& inwards) const {
  double least = clear_mm;
  for (std::size_t i = 0; i < structures_.size(); ++i) {
    if (std::find(kinds.begin(), kinds.end(), data_.structures[i].kind) == kinds.end()) continue;
    least = structures_.gap_mm(i, capsule, capsule - inwards * kToOutsideMm, least);
  }
  return std::max(0.0, std::ceil((clear_mm - least) / kCutStepMm - kRounding)) * kCutStepMm;
}

double PulledBones::distance_mm(const Vec3& point, double at_most_mm) const {
  double least = at_most_mm;
  for (std::size_t b = 0; b < data_.bones.size(); ++b) {
    const Vec3 local = (from_patient_[b] * Point<frame::Patient>{point}).v;
    if (!boxes_[b].grown(least + kFieldErrorMm).contains(local)) continue;
    if (data_.bones[b].distance_field.values().empty()) continue;
    const fields::DistanceSample s = fields::sample_distance(data_.bones[b].distance_field, local);
    if (s.is_inside_grid) least = std::min(least, s.distance_mm);
  }
  return least;
}

}  // namespace carpus::arthroscopy::detail
