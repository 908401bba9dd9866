// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case of the generic wrist's own surfaces, of any side, size and pose: bones only.
#pragma once

#include <algorithm>

#include "anatomy/wrist_model.hpp"
#include "cases/case_data.hpp"
#include "geometry/grid.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::soft_tissue::test {

/// Where a value is below 0.
template <typename Value>
TriangleMesh surface_of(const Aabb& box, const Value& value) {
  constexpr double kVoxelMm = 0.8;
  GridGeometry g;
  const Vec3 extent = box.extent();
  for (std::size_t a = 0; a < 3; ++a) g.size[a] = static_cast<int>(extent[a] / kVoxelMm) + 2;
  g.spacing = {kVoxelMm, kVoxelMm, kVoxelMm};
  g.origin = box.low;
  Grid<float> values(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    const VoxelIndex v = g.index_of(i);
    values[i] = static_cast<float>(-value(g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)})));
  }
  return mesh::extract_isosurface(values.view(), 0.0);
}

/// The surface of a model bone in the model's frame; shafts end at its cut.
inline TriangleMesh model_surface(const anatomy::WristModel& model, BoneId bone) {
  return surface_of(model.bone(bone).bounds.grown(1.0),
                    [&](const Vec3& p) { return model.signed_value(bone, p); });
}

/// Carpal bones and forearm.
inline cases::CaseData model_case(Side side, double size, const Mat3& patient_from_wrist) {
  const anatomy::WristModel& model = anatomy::WristModel::generic(side);
  cases::CaseData data;
  data.side = side;
  data.wrist_from_patient = {patient_from_wrist.transposed(), {3, -2, 5}};
  const auto patient_from = data.wrist_from_patient.inverse();
  for (std::size_t i = 0; i < static_cast<std::size_t>(BoneId::Hamate); ++i) {
    const BoneId bone = kAllBones[i];
    cases::Bone b;
    b.bone = bone;
    b.label = static_cast<std::uint8_t>(bone);
    TriangleMesh surface = model_surface(model, bone);
    for (Vec3& v : surface.vertices) v = (patient_from * Point<frame::Wrist>{v * size}).v;
    b.surface = MeshIn<frame::Bone>(std::move(surface));
    data.bones.push_back(std::move(b));
  }
  return data;
}

inline constexpr std::uint8_t kDistalPiece = 100;  ///< label

/// A left wrist whose scaphoid is broken square to its long axis, through its middle, its distal
/// piece moved towards radial, and then so far from all other bones as they wore it.
inline cases::CaseData broken_case(double step_mm, double worn_mm) {
  const anatomy::WristModel& model = anatomy::WristModel::generic(Side::Left);
  cases::CaseData data = model_case(Side::Left, 1, Mat3::identity());
  const auto patient_from = data.wrist_from_patient.inverse();
  const Aabb box = model.bone(BoneId::Scaphoid).bounds;
  const Vec3 distally{-0.556, -0.436, 0.707};
  const Vec3 radial{0, -1, 0};
  const Vec3 shift = normalized_or(radial - distally * dot(radial, distally), radial) * step_mm;
  const auto beyond_break = [&](const Vec3& p) { return dot(p - box.centre(), distally); };
  const auto whole = [&](const Vec3& p) { return model.signed_value(BoneId::Scaphoid, p); };
  const auto proximal = [&](const Vec3& p) { return std::max(whole(p), beyond_break(p)); };
  const auto distal = [&](const Vec3& p) {
    const Vec3 before = p - shift;
    double value = std::max(whole(before), -beyond_break(before));
    for (std::size_t i = 0; i < static_cast<std::size_t>(BoneId::Hamate); ++i) {
      if (kAllBones[i] == BoneId::Scaphoid) continue;
      if (!model.bone(kAllBones[i]).bounds.grown(worn_mm).contains(p)) continue;
      value = std::max(value, worn_mm - model.signed_value(kAllBones[i], p));
    }
    return value;
  };
  const auto scaphoid = std::find_if(data.bones.begin(), data.bones.end(),
                                     [](const auto& b) { return b.bone == BoneId::Scaphoid; });
  const auto place = [&](TriangleMesh surface) {
    for (Vec3& v : surface.vertices) v = (patient_from * Point<frame::Wrist>{v}).v;
    return MeshIn<frame::Bone>(std::move(surface));
  };
  scaphoid->part = BonePart::Proximal;
  scaphoid->surface = place(surface_of(box.grown(1.0), proximal));
  cases::Bone piece;
  piece.bone = BoneId::Scaphoid;
  piece.part = BonePart::Distal;
  piece.label = kDistalPiece;
  piece.surface = place(surface_of(box.grown(1.0 + length(shift)), distal));
  data.bones.push_back(std::move(piece));
  return data;
}

}  // namespace carpus::soft_tissue::test
