// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/bone_contact.hpp"

#include <string>
#include <vector>

#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "hull/quickhull.hpp"
#include "instruments/guide_wire.hpp"

namespace carpus::simulation::detail {
namespace {

constexpr double kFilterMarginMm = 1.0;  // wire radius, and a field's interpolation
constexpr int kMaxPushes = 6;            // a wedge between two bones settles in three or four
constexpr double kToleranceMm = 1e-4;    // penetration that is left alone: a tenth of a micrometre
constexpr int kMaxShaftSamples = 96;     // 80 mm in steps of at least 1 mm, and the tip

/// The wire as a square prism around it, thickened by the margin; no sin or cos, so that the filter
/// too is the same on every machine.
convex::ConvexBody thick_wire() {
  const double half = instruments::kWireRadiusMm + kHullMarginMm;
  std::vector<Vec3> corners;
  for (const double z : {-kHullMarginMm, instruments::kWireLengthMm}) {
    corners.insert(corners.end(),
                   {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
  }
  return convex::ConvexBody(hull::build_convex_hull(corners).polytope);
}

Pose<frame::Patient, frame::Tool> tool_pose(const WirePose& wire) noexcept {
  const Vec3 x = any_perpendicular(wire.shaft);
  return {Mat3::from_columns(x, cross(wire.shaft, x), wire.shaft), wire.tip};
}

}  // namespace

BoneContact::PosedBone::PosedBone(const cases::Bone& posed, const convex::ConvexBody& thick_wire)
    : bone(&posed),
      bone_from_patient(posed.patient_from_bone.inverse()),
      hull(posed.hull),
      hull_and_wire(hull, thick_wire) {
  for (const Vec3& v : posed.surface.vertices) {
    box.include((posed.patient_from_bone * Point<frame::Bone>{v}).v);
  }
  box = box.grown(kFilterMarginMm);
}

BoneContact::BoneContact(const cases::CaseData& posed_case) : thick_wire_(thick_wire()) {
  if (posed_case.bones.size() > kMaxBones) {
    throw InvalidInput("simulation: the case has " + std::to_string(posed_case.bones.size()) +
                       " bones, at most " + std::to_string(kMaxBones) + " are expected");
  }
  for (const cases::Bone& bone : posed_case.bones) {
    if (bone.distance_field.values().empty()) {
      throw InvalidInput("simulation: the " + std::string(name_of(bone.bone, bone.part)) +
                         " has no distance field; reconstruct the case again");
    }
    bones_.emplace_back(bone, thick_wire_);
  }
}

NearBones BoneContact::boxes_near(const WirePose& from, const WirePose& to) const noexcept {
  Aabb swept;
  swept.include(from.tip);
  swept.include(to.tip);
  swept.include(from.tip + from.shaft * instruments::kWireLengthMm);
  swept.include(to.tip + to.shaft * instruments::kWireLengthMm);
  NearBones near;
  for (std::size_t i = 0; i < bones_.size(); ++i) {
    if (bones_[i].box.overlaps(swept)) {
      near.index[near.count++] = static_cast<std::uint8_t>(i);
    }
  }
  return near;
}

NearBones BoneContact::hulls_met(const NearBones& near, const WirePose& wire) noexcept {
  const auto patient_from_tool = tool_pose(wire);
  NearBones met;
  for (std::uint8_t i = 0; i < near.count; ++i) {
    PosedBone& bone = bones_[near.index[i]];
    const auto bone_from_tool = bone.bone_from_patient * patient_from_tool;
    const auto verdict =
        bone.hull_and_wire.meets({bone_from_tool.rotation, bone_from_tool.translation});
    if (verdict != convex::Verdict::Apart) met.index[met.count++] = near.index[i];
  }
  return met;
}

SurfacePoint BoneContact::surface_of(const PosedBone& bone, const Vec3& point) const noexcept {
  SurfacePoint result;
  if (!bone.box.contains(point)) return result;
  const Vec3 local = (bone.bone_from_patient * Point<frame::Patient>{point}).v;
  const auto sample = fields::sample_distance(bone.bone->distance_field, local);
  if (!sample.is_inside_grid) return result;
  result.is_near = true;
  result.distance_mm = sample.distance_mm;
  const Vec3 normal_in_bone = normalized_or(sample.gradient, {0, 0, 0});
  result.normal_in_patient =
      (bone.bone->patient_from_bone * Direction<frame::Bone>{normal_in_bone}).v;
  result.label = bone.bone->label;
  return result;
}

SurfacePoint BoneContact::surface_at(const NearBones& near, const Vec3& point) const noexcept {
  SurfacePoint best;
  for (std::uint8_t i = 0; i < near.count; ++i) {
    const SurfacePoint candidate = surface_of(bones_[near.index[i]], point);
    if (candidate.is_near && (!best.is_near || candidate.distance_mm < best.distance_mm)) {
      best = candidate;
    }
  }
  return best;
}

SurfacePoint BoneContact::surface_at(const Vec3& point) const noexcept {
  SurfacePoint best;
  for (const PosedBone& bone : bones_) {
    const SurfacePoint candidate = surface_of(bone, point);
    if (candidate.is_near && (!best.is_near || candidate.distance_mm < best.distance_mm)) {
      best = candidate;
    }
  }
  return best;
}

BoneContact::Penetration BoneContact::deepest_in(const PosedBone& bone,
                                                 const WirePose& wire) const noexcept {
  // Marches along the shaft by the distance found, so that free stretches cost one sample.
  constexpr double kLeastStepMm = 1.0;
  Penetration deepest;
  double along = 0;
  for (int i = 0; i < kMaxShaftSamples && along <= instruments::kWireLengthMm; ++i) {
    const Vec3 p = wire.tip + wire.shaft * along;
    const Vec3 local = (bone.bone_from_patient * Point<frame::Patient>{p}).v;
    const auto sample = fields::sample_distance(bone.bone->distance_field, local);
    const double radius = instruments::wire_radius_at(along);
    const double depth = radius - sample.distance_mm;
    if (sample.is_inside_grid && depth > deepest.depth_mm) {
      const Vec3 normal = normalized_or(sample.gradient, {0, 0, 0});
      if (squared_length(normal) > 0) {
        deepest.depth_mm = depth;
        deepest.normal_in_patient =
            (bone.bone->patient_from_bone * Direction<frame::Bone>{normal}).v;
      }
    }
    const double clear = sample.distance_mm - instruments::kWireRadiusMm;
    along += clear > kLeastStepMm ? clear : kLeastStepMm;
  }
  return deepest;
}

Resolved BoneContact::push_out(const NearBones& near, WirePose wire) const noexcept {
  Resolved result{wire.tip, true, false};
  for (int push = 0; push < kMaxPushes; ++push) {
    Penetration deepest;
    for (std::uint8_t i = 0; i < near.count; ++i) {
      const Penetration candidate = deepest_in(bones_[near.index[i]], wire);
      if (candidate.depth_mm > deepest.depth_mm) deepest = candidate;
    }
    if (!(deepest.depth_mm > kToleranceMm)) {
      result.tip = wire.tip;
      return result;
    }
    result.is_free = false;
    wire.tip += deepest.normal_in_patient * deepest.depth_mm;
    // Further than the filter's margin other bones might be met unseen.
    if (distance(wire.tip, result.tip) > kHullMarginMm) break;
  }
  result.is_wedged = true;
  return result;
}

}  // namespace carpus::simulation::detail
