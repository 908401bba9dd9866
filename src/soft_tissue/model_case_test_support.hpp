// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case of the generic wrist's own surfaces, of any side, size and pose: bones only.
#pragma once

#include "anatomy/wrist_model.hpp"
#include "cases/case_data.hpp"
#include "geometry/grid.hpp"
#include "mesh/marching_cubes.hpp"

namespace carpus::soft_tissue::test {

/// The surface of a model bone in the model's frame; shafts end at its cut.
inline TriangleMesh model_surface(const anatomy::WristModel& model, BoneId bone) {
  constexpr double kVoxelMm = 0.8;
  const Aabb box = model.bone(bone).bounds.grown(1.0);
  GridGeometry g;
  const Vec3 extent = box.extent();
  for (std::size_t a = 0; a < 3; ++a) g.size[a] = static_cast<int>(extent[a] / kVoxelMm) + 2;
  g.spacing = {kVoxelMm, kVoxelMm, kVoxelMm};
  g.origin = box.low;
  Grid<float> values(g);
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    const VoxelIndex v = g.index_of(i);
    values[i] = static_cast<float>(-model.signed_value(
        bone, g.patient_from_voxel(
                  {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)})));
  }
  return mesh::extract_isosurface(values.view(), 0.0);
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

}  // namespace carpus::soft_tissue::test
