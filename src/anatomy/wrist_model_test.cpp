// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/wrist_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::anatomy {
namespace {

/// The file prints values to 1e-5 mm; what is left is the rounding of the last digit.
constexpr double kCheckToleranceMm = 2e-5;

double sampled_volume_mm3(const WristModel& model, BoneId id, double step) {
  const Aabb& box = model.bone(id).bounds;
  double volume = 0;
  for (double x = box.low.x; x <= box.high.x; x += step)
    for (double y = box.low.y; y <= box.high.y; y += step)
      for (double z = box.low.z; z <= box.high.z; z += step)
        if (model.signed_value(id, {x, y, z}) < 0) volume += step * step * step;
  return volume;
}

TEST(WristModel, AgreesWithTheCheckValuesOfItsFile) {
  for (const Side side : {Side::Left, Side::Right}) {
    for (const ModelBone& bone : WristModel::generic(side).bones()) {
      ASSERT_EQ(bone.check_values.size(), 3U);
      for (const ModelCheckValue& check : bone.check_values) {
        EXPECT_NEAR(WristModel::generic(side).uncut_value(bone.bone, check.point), check.value_mm,
                    kCheckToleranceMm)
            << name_of(bone.bone) << ' ' << name_of(side);
      }
    }
  }
}

TEST(WristModel, EnclosesTheVolumesOfItsFile) {
  for (const ModelBone& bone : WristModel::generic().bones()) {
    const double volume = sampled_volume_mm3(WristModel::generic(), bone.bone, 0.5);
    EXPECT_NEAR(volume, bone.volume_mm3, 0.01 * bone.volume_mm3) << name_of(bone.bone);
  }
}

TEST(WristModel, BoundsHoldEveryPointOfTheBone) {
  const WristModel& model = WristModel::generic();
  Rng rng(1);
  for (const ModelBone& bone : model.bones()) {
    const Aabb wide = bone.bounds.grown(4.0);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 p{rng.uniform(wide.low.x, wide.high.x), rng.uniform(wide.low.y, wide.high.y),
                   rng.uniform(wide.low.z, wide.high.z)};
      if (model.signed_value(bone.bone, p) < 0) {
        EXPECT_TRUE(bone.bounds.contains(p));
      }
    }
  }
}

TEST(WristModel, RightWristIsTheMirrorImageOfTheLeft) {
  const WristModel& left = WristModel::generic(Side::Left);
  const WristModel& right = WristModel::generic(Side::Right);
  EXPECT_EQ(right.side(), Side::Right);
  Rng rng(2);
  for (const BoneId bone : kAllBones) {
    EXPECT_EQ(right.bone(bone).bounds.low.y, -left.bone(bone).bounds.high.y);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p{rng.uniform(-40, 20), rng.uniform(-30, 30), rng.uniform(-20, 20)};
      const Vec3 q{p.x, -p.y, p.z};
      EXPECT_NEAR(left.signed_value(bone, p), right.signed_value(bone, q), 1e-9);
    }
    for (const ModelEllipsoid& e : right.bone(bone).ellipsoids) {
      EXPECT_NEAR(e.wrist_from_axes.determinant(), 1.0, 1e-9);
    }
  }
}

TEST(WristModel, BonesDoNotOverlap) {
  const WristModel& model = WristModel::generic();
  Rng rng(3);
  for (int i = 0; i < 200000; ++i) {
    const Vec3 p{rng.uniform(-40, 20), rng.uniform(-30, 30), rng.uniform(-20, 20)};
    int owners = 0;
    for (const ModelBone& bone : model.bones()) {
      if (bone.bounds.contains(p) && model.signed_value(bone.bone, p) < 0) ++owners;
    }
    EXPECT_LE(owners, 1);
  }
}

TEST(WristModel, OnlyLongBonesHaveACutAndAShaft) {
  for (const ModelBone& bone : WristModel::generic().bones()) {
    const bool is_long = belongs_to_forearm(bone.bone) || bone.bone >= BoneId::Metacarpal1;
    EXPECT_EQ(bone.cut_plane.has_value(), is_long);
    EXPECT_NEAR(length(bone.shaft_axis), is_long ? 1.0 : 0.0, 1e-9);
    if (is_long) {
      EXPECT_GT(dot(bone.shaft_axis, bone.cut_plane->normal), 0.5);
    }
  }
}

TEST(WristModel, RefusesATextThatIsNoModelAndSaysWhere) {
  EXPECT_THROW((void)WristModel::parse("{"), InvalidInput);
  EXPECT_THROW((void)WristModel::parse(R"({"version": 2, "bones": []})"), InvalidInput);
  EXPECT_THROW((void)WristModel::parse(R"({"version": 1, "bones": []})"), InvalidInput);
  try {
    (void)WristModel::parse(R"({"version": 1, "bones": [{"name": "navicular"}]})");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("navicular"), std::string::npos);
  }
}

}  // namespace
}  // namespace carpus::anatomy
