// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Naming on voxels made from the model itself, turned, scaled, mirrored and broken: this proves the
// logic. How well it does on another anatomy is measured in reconstruct.
#include "anatomy/bone_naming.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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
  std::vector<BoneId> whole;   ///< metacarpals that are there to their heads
  bool has_phalanges = false;  ///< numbered from 17
  /// The field of view ends here, along the model's x towards the elbow.
  double proximal_limit_mm = 1e3;
};

/// Lengths of adults' metacarpals 1 to 5 [mm].
constexpr std::array<double, 5> kMetacarpalMm{46, 68, 65, 57, 53};

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
  return distance(p, a + (b - a) * t);
}

/// The middle of a model bone's cut, from where its shaft goes on.
Vec3 cut_centre(const WristModel& model, const ModelBone& bone) {
  Vec3 sum;
  double count = 0;
  const Aabb& box = bone.bounds;
  for (double x = box.low.x; x < box.high.x; x += 0.5) {
    for (double y = box.low.y; y < box.high.y; y += 0.5) {
      for (double z = box.low.z; z < box.high.z; z += 0.5) {
        if (std::abs(bone.cut_plane->signed_distance({x, y, z})) < 0.5 &&
            model.uncut_value(bone.bone, {x, y, z}) < 0) {
          sum += {x, y, z};
          count += 1;
        }
      }
    }
  }
  return sum / count;
}

/// A shaft with a head at its end, and the proximal phalanx beyond it.
struct Ray {
  BoneId bone;
  Vec3 from, head, phalanx_from, phalanx_to;

  Ray(const WristModel& model, BoneId id) : bone(id) {
    const ModelBone& b = model.bone(id);
    from = cut_centre(model, b);
    const std::size_t k =
        static_cast<std::size_t>(id) - static_cast<std::size_t>(BoneId::Metacarpal1);
    head = from + b.shaft_axis * (kMetacarpalMm[k] - 24.0);
    phalanx_from = head + b.shaft_axis * 13.0;
    phalanx_to = phalanx_from + b.shaft_axis * 25.0;
  }
  [[nodiscard]] bool in_metacarpal(const Vec3& p) const {
    return distance_to_segment(p, from, head) < 4.5 || distance(p, head) < 7.0;
  }
  [[nodiscard]] bool in_phalanx(const Vec3& p) const {
    return distance_to_segment(p, phalanx_from, phalanx_to) < 4.5;
  }
};

/// The model as regions, numbered by bone (16 = distal part of a broken scaphoid).
WristVoxels voxels_of(const WristOptions& options) {
  const WristModel& model = WristModel::generic(options.side);
  const Mat3 turn = rotation_about(normalized_or(options.turn_axis, {0, 0, 1}), options.turn_rad);
  const Pose<frame::Wrist, frame::Patient> wrist_from_patient{turn, {3, -8, 12}};
  const auto patient_from_wrist = wrist_from_patient.inverse();
  std::vector<Ray> rays;
  for (const BoneId bone : options.whole) rays.emplace_back(model, bone);
  Aabb box;
  for (const Ray& ray : rays) {
    for (const Vec3& end : {ray.head, ray.phalanx_to}) {
      if (!options.has_phalanges && &end == &ray.phalanx_to) continue;
      Aabb at;
      at.include((patient_from_wrist * Point<frame::Wrist>{options.scale * end}).v);
      box.include(at.grown(10));
    }
  }
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
  if (options.turn_rad == 0) {
    box.high.x = std::min(
        box.high.x, options.scale * options.proximal_limit_mm - wrist_from_patient.translation.x);
  }
  g.origin = box.low;
  for (std::size_t a = 0; a < 3; ++a) g.size[a] = static_cast<int>(box.extent()[a] / 0.9) + 1;
  WristVoxels result{Grid<std::uint16_t>(g),
                     static_cast<std::uint16_t>(15 + (options.broken_scaphoid ? 1 : 0) +
                                                (options.has_phalanges ? 6 : 0)),
                     wrist_from_patient};
  const Vec3 waist = model.bone(BoneId::Scaphoid).bounds.centre();
  for (std::size_t i = 0; i < result.regions.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const Vec3 m = (wrist_from_patient * Point<frame::Patient>{p}).v / options.scale;
    if (m.x > options.proximal_limit_mm) continue;
    for (const Ray& ray : rays) {
      if (ray.in_metacarpal(m)) result.regions[i] = static_cast<std::uint16_t>(ray.bone);
      if (options.has_phalanges && ray.in_phalanx(m)) {
        result.regions[i] = static_cast<std::uint16_t>(static_cast<int>(ray.bone) + 6);
      }
    }
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

constexpr std::array<BoneId, 5> kMetacarpals{BoneId::Metacarpal1, BoneId::Metacarpal2,
                                             BoneId::Metacarpal3, BoneId::Metacarpal4,
                                             BoneId::Metacarpal5};

void expect_no_long_bone_suspicious(const BoneNaming& naming,
                                    const std::vector<BoneId>& bones,
                                    double most) {
  for (const BoneId bone : bones) {
    const auto& name = naming.regions[static_cast<std::size_t>(bone) - 1];
    ASSERT_TRUE(name.has_value()) << name_of(bone);
    EXPECT_LT(name->cost, most) << name_of(bone);
  }
}

TEST(BoneNaming, KnowsMetacarpalsThatAreThereWhole) {
  WristOptions options;
  options.whole.assign(kMetacarpals.begin(), kMetacarpals.end());
  options.turn_axis = {1, 2, 0.5};
  options.turn_rad = 1.3;
  const WristVoxels wrist = voxels_of(options);
  const BoneNaming naming = name_bones(wrist.regions.view(), wrist.count);
  expect_every_bone_named(wrist, naming, Side::Left);
  expect_no_long_bone_suspicious(naming, options.whole, 1.5);
}

TEST(BoneNaming, KnowsTheFirstMetacarpalThatAloneIsWhole) {
  for (const Side side : {Side::Left, Side::Right}) {
    WristOptions options;
    options.side = side;
    options.whole = {BoneId::Metacarpal1};
    const WristVoxels wrist = voxels_of(options);
    const BoneNaming naming = name_bones(wrist.regions.view(), wrist.count);
    expect_every_bone_named(wrist, naming, side);
    expect_no_long_bone_suspicious(naming, options.whole, 1.5);
  }
}

TEST(BoneNaming, LeavesFingersOutOfTheAccount) {
  WristOptions options;
  options.whole.assign(kMetacarpals.begin(), kMetacarpals.end());
  options.has_phalanges = true;
  options.turn_axis = {0, 1, 1};
  options.turn_rad = 2.1;
  const WristVoxels wrist = voxels_of(options);
  const BoneNaming naming = name_bones(wrist.regions.view(), wrist.count);
  expect_every_bone_named(wrist, naming, Side::Left);
  for (std::size_t i = 15; i < naming.regions.size(); ++i) {
    EXPECT_FALSE(naming.regions[i].has_value()) << i;
  }
  EXPECT_GE(naming.far_bodies, 5U);
}

TEST(BoneNaming, ComparesAForearmOverTheLengthThatTheScanShows) {
  for (const double limit :
       {14.0, 11.0, 8.0}) {  // at 8, 17 mm of the radius and 5 of the ulna are left
    WristOptions options;
    options.proximal_limit_mm = limit;
    SCOPED_TRACE(limit);
    const WristVoxels wrist = voxels_of(options);
    const BoneNaming naming = name_bones(wrist.regions.view(), wrist.count);
    expect_every_bone_named(wrist, naming, Side::Left);
    expect_no_long_bone_suspicious(naming, {BoneId::Radius, BoneId::Ulna}, 2.0);
    EXPECT_NE(naming.status, NamingStatus::NotAWrist);
  }
}

TEST(BoneNaming, OneBadBoneDoesNotCondemnTheOthers) {
  WristOptions options;
  options.whole.assign(kMetacarpals.begin(), kMetacarpals.end());
  options.proximal_limit_mm = 12;
  WristVoxels wrist = voxels_of(options);
  // A pisiform swollen by what leaked into it: dilated by 4 mm where nothing else is.
  const GridGeometry& g = wrist.regions.geometry();
  const auto pisiform = static_cast<std::uint16_t>(BoneId::Pisiform);
  for (int round = 0; round < 4; ++round) {
    const Grid<std::uint16_t> before = wrist.regions;
    for (std::size_t i = 0; i < before.values().size(); ++i) {
      if (before[i] != 0) continue;
      const VoxelIndex v = g.index_of(i);
      for (const VoxelIndex& n : {VoxelIndex{v.x - 1, v.y, v.z}, VoxelIndex{v.x + 1, v.y, v.z},
                                  VoxelIndex{v.x, v.y - 1, v.z}, VoxelIndex{v.x, v.y + 1, v.z},
                                  VoxelIndex{v.x, v.y, v.z - 1}, VoxelIndex{v.x, v.y, v.z + 1}}) {
        if (g.contains(n) && before[n] == pisiform) wrist.regions[i] = pisiform;
      }
    }
  }
  const BoneNaming naming = name_bones(wrist.regions.view(), wrist.count);
  EXPECT_EQ(naming.status, NamingStatus::Doubtful);
  ASSERT_TRUE(naming.regions[pisiform - 1U].has_value());
  EXPECT_GE(naming.regions[pisiform - 1U]->cost, kSuspiciousBoneCost);
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
