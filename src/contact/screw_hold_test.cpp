// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/screw_hold.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/allocation_test_support.hpp"
#include "fields/cut_tissue.hpp"
#include "fields/distance_field.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using fields::CutBone;
using fields::CutTissue;

constexpr ThreadedCylinderShape kScrew{.core_radius_mm = 1.2,
                                       .crest_radius_mm = 2.0,
                                       .pitch_mm = 1.0,
                                       .length_mm = 12};
constexpr double kRingMm2 = kPi * (2.0 * 2.0 - 1.2 * 1.2);

/// A block 16 mm wide of 520 HU, half of full weight.
struct Block {
  Block()
      : bones([] {
          const TriangleMesh mesh = fields::test::box({8, 8, 8});
          return std::vector<fields::ContactField>{
              {fields::build_distance_field(mesh, {.spacing_mm = 0.4, .band_mm = 4}), mesh}};
        }()),
        tissue(bones),
        ct(GridGeometry{{25, 25, 25}, {1, 1, 1}, {-12, -12, -12}, Mat3::identity()},
           std::int16_t{520}) {}

  [[nodiscard]] ScrewHold hold(const Vec3& tip, const Vec3& shaft = {0, 0, 1}) const {
    const Grid<std::int16_t>& constant = ct;
    return screw_hold(CutBone{bones[0], tissue.field(0)}, constant.view(), kScrew,
                      {fields::test::turned_to(shaft), tip});
  }
  std::vector<fields::ContactField> bones;
  CutTissue tissue;
  Grid<std::int16_t> ct;
};

TEST(ScrewHold, IsTheRingOfBoneByItsDensity) {
  const Block block;
  const ScrewHold whole = block.hold({0, 0, -6});
  EXPECT_NEAR(whole.bone_mm3, 0.5 * kRingMm2 * 12, 0.01 * kRingMm2 * 12);
  EXPECT_EQ(whole.share(), 1);
  EXPECT_NEAR(whole.turns, 12, 1e-9);
  const ScrewHold turned = block.hold({0, 0, 0}, normalized_or({1, 1, 0.5}, {}));
  EXPECT_LT(turned.bone_mm3, whole.bone_mm3);
  const ScrewHold half = block.hold({0, 0, 2});  // 6 of its 12 mm stick out
  EXPECT_NEAR(half.bone_mm3, 0.5 * whole.bone_mm3, 0.03 * whole.bone_mm3);
  EXPECT_NEAR(half.turns, 6, 0.6);
  EXPECT_EQ(block.hold({40, 0, 0}).share(), 0);
}

TEST(ScrewHold, IsUntouchedByItsOwnCoreAndLessByEachWiderHole) {
  Block block;
  double last = 1;
  for (const double radius : {0.57, 1.2, 1.4, 1.6, 1.8, 2.1}) {
    (void)block.tissue.remove(0, SweptTool::bar({0, 0, -9}, radius, {0, 0, 9}, radius));
    const double share = block.hold({0, 0, -6}).share();
    const double left = (2.0 * 2.0 - radius * radius) / (2.0 * 2.0 - 1.2 * 1.2);
    EXPECT_NEAR(share, std::clamp(left, 0.0, 1.0), 0.06) << radius;
    EXPECT_LE(share, last);
    last = share;
  }
  EXPECT_LT(last, 0.03);
}

TEST(ScrewHold, IsLessAfterASecondPassAndBackAfterUndo) {
  Block block;
  block.tissue.checkpoint();
  (void)block.tissue.remove(0, SweptTool::bar({1.5, 0, -9}, 0.57, {0.8, 0, 9}, 0.57));
  const double share = block.hold({0, 0, -6}).share();
  EXPECT_LT(share, 0.97);
  EXPECT_GT(share, 0.75);
  ASSERT_TRUE(block.tissue.undo());
  EXPECT_EQ(block.hold({0, 0, -6}).share(), 1);
}

TEST(ScrewHold, GoesAsTheThreadIsStripped) {
  Block block;
  const Pose<frame::Bone, frame::Tool> pose{Mat3::identity(), {0, 0, -6}};
  double last = 1;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    (void)block.tissue.remove(0, stripped_thread(kScrew, pose, share));
    const double hold = block.hold({0, 0, -6}).share();
    EXPECT_LT(hold, last);
    last = hold;
  }
  EXPECT_LT(last, 0.2);  // what is left is at its rounded ends
  EXPECT_EQ(stripping_compression_n(1, 1), kGreatestCompressionN);
  EXPECT_EQ(stripping_compression_n(1, 0.25), 25);
  EXPECT_EQ(stripping_compression_n(-1, 0.25), 0);
  EXPECT_LE(kGreatestCompressionN, 103.9 + 33.2);
}

TEST(ScrewHold, AllocatesNothing) {
  const Block block;
  carpus::test::start_counting_allocations();
  (void)block.hold({0, 0, -6});
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
}

}  // namespace
}  // namespace carpus::contact
