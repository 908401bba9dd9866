// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Naming on voxels made from the model itself, turned, scaled, mirrored and broken: this proves the
// logic. How well it does on another anatomy is measured in reconstruct.
#include "anatomy/bone_naming.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anatomy/wrist_model.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"

namespace carpus::anatomy {
namespace {

struct WristVoxels {
  Grid<std::uint16_t> regions;
  std::uint16_t count = 0;
  Pose<frame::Wrist, frame::Patient> wrist_from_patient;
};

struct WristOptions {
  Side side = Side::Left;
  double scale = 1.0;
  Vec3 turn_axis{0, 0, 1};
  double turn_rad = 0;
  bool broken_scaphoid = false;
  std::vector<BoneId> left_out;
};

/// The model as regions, numbered by bone (16 = distal part of a broken scaphoid).
WristVoxels voxels_of(const WristOptions& options) {
  const WristModel& model = WristModel::generic(options.side);
  const Mat3 turn = rotation_about(normalized_or(options.turn_axis, {0, 0, 1}), options.turn_rad);
  const Pose<frame::Wrist, frame::Patient> wrist_from_patient{turn, {3, -8, 12}};
  const auto patient_from_wrist = wrist_from_patient.inverse();
  Aabb box;
  for (const ModelBone& bone : model.bones()) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{(corner & 1) != 0 ? bone.bounds.low.x : bone.bounds.high.x,
                   (corner & 2) != 0 ? bone.bounds.low.y : bone.bounds.high.y,
                   (corner & 4) != 0 ? bone.bounds.low.z : bone.bounds.high.z};
      box.include((patient_from_wrist * Point<frame::Wrist>{options.scale * p}).v);
    }
  }
  GridGeometry g;
  g.spacing = {0.9, 0.9, 0.9};
  g.origin = box.low;
  for (std::size_t a = 0; a < 3; ++a) g.size[a] = static_cast<int>(box.extent()[a] / 0.9) + 1;
  WristVoxels result{Grid<std::uint16_t>(g),
                     options.broken_scaphoid ? std::uint16_t{16} : std::uint16_t{15},
                     wrist_from_patient};
  const Vec3 waist = model.bone(BoneId::Scaphoid).bounds.centre();
  for (std::size_t i = 0; i < result.regions.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const Vec3 m = (wrist_from_patient * Point<frame::Patient>{p}).v / options.scale;
    for (const ModelBone& bone : model.bones()) {
      if (std::count(options.left_out.begin(), options.left_out.end(), bone.bone) > 0) continue;
      if (!bone.bounds.contains(m) || !(model.signed_value(bone.bone, m) < 0)) continue;
      auto label = static_cast<std::uint16_t>(bone.bone);
      if (bone.bone == BoneId::Scaphoid && options.broken_scaphoid) {
        const double along = m.x - waist.x;
        if (std::abs(along) < 0.9) continue;  // the gap
        if (along < 0) label = 16;
      }
      result.regions[i] = label;
    }
  }
  return result;
}

/// In these voxels no shaft reaches the volume's face, as all bones end at the model's cut; the
/// mismatch costs 6 for each of seven long bones, alike for right and wrong names.
void expect_every_bone_named(const WristVoxels& wrist, const BoneNaming& naming, Side side) {
  EXPECT_EQ(naming.side, side);
  for (const BoneId bone : kAllBones) {
    const auto& name = naming.regions[static_cast<std::size_t>(bone) - 1];
    ASSERT_TRUE(name.has_value()) << name_of(bone);
    EXPECT_EQ(name->bone, bone) << name_of(bone);
  }
  EXPECT_TRUE(naming.missing.empty());
  EXPECT_GT(naming.other_side_cost, naming.cost + 20);
  EXPECT_NEAR(naming.wrist_from_patient.rotation.determinant(), 1.0, 1e-9);
  const Mat3 error =
      naming.wrist_from_patient.rotation * wrist.wrist_from_patient.rotation.transposed();
  const double cosine = (error.rows[0].x + error.rows[1].y + error.rows[2].z - 1) / 2;
  EXPECT_LT(degrees_from_radians(std::acos(std::min(cosine, 1.0))), 2.0);
  const Point<frame::Patient> origin = wrist.wrist_from_patient.inverse() * Point<frame::Wrist>{};
  EXPECT_LT(length((naming.wrist_from_patient * origin).v), 0.5);
}

TEST(BoneNaming, NamesEitherSideInAnyOrientationAndSize) {
  Rng rng(5);
  for (const Side side : {Side::Left, Side::Right}) {
    for (const double scale : {0.9, 1.15}) {
      WristOptions options;
      options.side = side;
      options.scale = scale;
      options.turn_axis = {rng.normal(), rng.normal(), rng.normal()};
      options.turn_rad = rng.uniform(0, 6);
      const WristVoxels wrist = voxels_of(options);
      const BoneNaming naming = name_bones(wrist.regions.view(), wrist.count);
      expect_every_bone_named(wrist, naming, side);
      EXPECT_NEAR(naming.scale, scale, 0.05);
    }
  }
}

TEST(BoneNaming, AMirroredVolumeIsTheOtherSide) {
  const WristVoxels wrist = voxels_of({});
  Grid<std::uint16_t> mirrored(wrist.regions.geometry());
  const GridGeometry& g = mirrored.geometry();
  for (std::size_t i = 0; i < mirrored.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    mirrored[VoxelIndex{g.size[0] - 1 - v.x, v.y, v.z}] = wrist.regions[i];
  }
  const BoneNaming a = name_bones(wrist.regions.view(), wrist.count);
  const BoneNaming b = name_bones(mirrored.view(), wrist.count);
  EXPECT_EQ(a.side, Side::Left);
  EXPECT_EQ(b.side, Side::Right);
  for (std::size_t i = 0; i < kBoneCount; ++i) {
    ASSERT_TRUE(a.regions[i].has_value() && b.regions[i].has_value());
    EXPECT_EQ(a.regions[i]->bone, b.regions[i]->bone);
  }
}

TEST(BoneNaming, FindsThePartsOfABrokenScaphoid) {
  for (const Side side : {Side::Left, Side::Right}) {
    WristOptions options;
    options.side = side;
    options.broken_scaphoid = true;
    options.turn_rad = 2.5;
    const WristVoxels wrist = voxels_of(options);
    const BoneNaming naming = name_bones(wrist.regions.view(), wrist.count);
    expect_every_bone_named(wrist, naming, side);
    EXPECT_EQ(naming.regions[2]->part, BonePart::Proximal);
    ASSERT_TRUE(naming.regions[15].has_value());
    EXPECT_EQ(naming.regions[15]->bone, BoneId::Scaphoid);
    EXPECT_EQ(naming.regions[15]->part, BonePart::Distal);
  }
}

TEST(BoneNaming, SaysWhichBonesAreMissing) {
  WristOptions options;
  options.left_out = {BoneId::Pisiform, BoneId::Metacarpal5};
  const WristVoxels wrist = voxels_of(options);
  // Numbers without holes, as a segmentation gives them.
  Grid<std::uint16_t> packed = wrist.regions;
  for (std::uint16_t& r : packed.values()) r = r > 6 ? static_cast<std::uint16_t>(r - 1) : r;
  const BoneNaming naming = name_bones(packed.view(), 13);
  EXPECT_EQ(naming.missing, options.left_out);
  EXPECT_EQ(naming.side, Side::Left);
  EXPECT_EQ(naming.regions[2]->bone, BoneId::Scaphoid);
  EXPECT_EQ(naming.regions[8 - 1]->bone, BoneId::Capitate);
}

TEST(BoneNaming, RefusesWhatIsNoWrist) {
  GridGeometry g;
  g.size = {100, 100, 30};
  Grid<std::uint16_t> blocks(g);
  for (std::size_t i = 0; i < blocks.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (v.x % 25 > 2 && v.y % 25 > 2 && v.z > 4 && v.z < 26) {
      blocks[i] = static_cast<std::uint16_t>(1 + v.x / 25 + 4 * (v.y / 25));
    }
  }
  EXPECT_EQ(name_bones(blocks.view(), 16).status, NamingStatus::NotAWrist);
  EXPECT_EQ(name_bones(Grid<std::uint16_t>(g).view(), 0).status, NamingStatus::NotAWrist);
  EXPECT_EQ(name_bones(Grid<std::uint16_t>(g, 1).view(), 1).status, NamingStatus::NotAWrist);
}

}  // namespace
}  // namespace carpus::anatomy
