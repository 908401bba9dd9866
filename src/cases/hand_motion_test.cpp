// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/hand_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/make_hand_motion.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "core/allocation_test_support.hpp"
#include "core/counting_new_test_support.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"

namespace carpus::cases {
namespace {

using anatomy::CarpalGroup;
using anatomy::HandPose;
using Motion = Pose<frame::Patient, frame::Bone>;

void shift(Bone& bone, const Vec3& by) {
  for (Vec3& v : bone.surface.vertices) v += by;
  GridGeometry geometry = bone.distance_field.geometry();
  geometry.origin += by;
  const auto values = bone.distance_field.values();
  bone.distance_field = Grid<float>(geometry, {values.begin(), values.end()});
}

/// The synthetic wrist with its bones moved together, so that hand poses would make them overlap.
CaseData tight_case() {
  CaseData data = test::synthetic_case();
  for (Bone& bone : data.bones) {
    if (bone.bone == BoneId::Radius) shift(bone, {0, 0, -1});
    if (bone.bone == BoneId::Lunate) shift(bone, {2.5, 0, 0});
    if (bone.bone == BoneId::Capitate) shift(bone, {4, 0, 1.5});
    if (bone.bone == BoneId::Trapezium) shift(bone, {-3, 4, 3});
  }
  return data;
}

const CaseData& wrist() {
  static const CaseData data = [] {
    CaseData made = tight_case();
    made.hand_motion = make_hand_motion(made);
    return made;
  }();
  return data;
}
const HandMotion& motion() { return wrist().hand_motion; }

HandPose from_scan(double flexion_deg, double deviation_deg) {
  HandPose pose = motion().scan;
  pose.flexion_rad += radians_from_degrees(flexion_deg);
  pose.radial_deviation_rad += radians_from_degrees(deviation_deg);
  return pose;
}

Motion of(CarpalGroup group, const HandPose& pose) {
  return motion().poses_at(pose)[static_cast<std::size_t>(group)];
}

Vec3 moved(CarpalGroup group, const HandPose& pose, const Vec3& point) {
  return (of(group, pose) * Point<frame::Bone>{point}).v;
}

Vec3 middle_of(BoneId id) { return centroid_of(find_bone(wrist(), id)->surface); }

TEST(HandMotion, IsExactlyTheIdentityInThePoseOfTheScan) {
  for (const Motion& m : motion().poses_at(motion().scan)) EXPECT_EQ(m, Motion{});
}

TEST(HandMotion, IsTheIdentityInACaseWithoutATable) {
  for (const Motion& m : HandMotion{}.poses_at({0.5, 0.1, 0.3, 20})) EXPECT_EQ(m, Motion{});
}

TEST(HandMotion, LetsNoBonesPassIntoEachOther) {
  EXPECT_LE(motion().report.overlap_at_nodes_mm, 0.1);
  EXPECT_LE(motion().report.overlap_between_nodes_mm, 0.1);
  EXPECT_LE(motion().report.overlap_in_pronation_mm, 0.1);
  EXPECT_GT(motion().report.overlap_of_model_mm, 0.15);  // there was something to correct
  Rng rng(7);
  for (int i = 0; i < 40; ++i) {
    const HandPose pose{rng.uniform(-1.4, 1.4), rng.uniform(-0.7, 0.45), 0, 0};
    EXPECT_LE(overlap_at(wrist(), motion(), pose), 0.1);
  }
}

TEST(HandMotion, CountsAnOverlapThatIsThere) {
  HandMotion shifted = motion();
  for (HandMotionNode& node : shifted.nodes) {
    node.groups[static_cast<std::size_t>(CarpalGroup::Hand)].shift.z += 6;  // towards the radius
  }
  EXPECT_GT(overlap_at(wrist(), shifted, motion().scan), 0.5);
}

TEST(HandMotion, HoldsTheHandAsAsked) {
  const auto& model = anatomy::CarpalKinematics::published();
  const Mat3& wrist_axes = wrist().wrist_from_patient.rotation;
  const Mat3 scan = model.rotation_from_neutral(CarpalGroup::Hand, motion().scan, Side::Left);
  for (const double flexion_rad : motion().flexion_rad) {
    const HandPose pose{flexion_rad, motion().scan.radial_deviation_rad, 0, 0};
    if (motion().limits.reach(pose) > 1) continue;
    const Mat3 asked =
        model.rotation_from_neutral(CarpalGroup::Hand, pose, Side::Left) * scan.transposed();
    const Mat3 held = wrist_axes * of(CarpalGroup::Hand, pose).rotation * wrist_axes.transposed();
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(distance(asked.rows[i], held.rows[i]), 1e-5);
  }
}

TEST(HandMotion, KeepsJointsFromFallingApart) {
  // Within the active range no carpal bone leaves its place by what its own rotation about the
  // wrist's centre does not explain: its middle stays within a bone's width of the model's.
  for (const CarpalGroup group : anatomy::kMovingGroups) {
    EXPECT_LT(motion().report.corrections[static_cast<std::size_t>(group)].mean_shift_mm, 4);
  }
}

TEST(HandMotion, IsContinuousThroughNodesAndAlongTheLimits) {
  const Vec3 far_point = middle_of(BoneId::Capitate) + Vec3{0, 0, -60};  // a fingertip, nearly
  constexpr int kSteps = 4000;
  for (const double slope : {-0.5, 0.1, 0.7}) {
    Vec3 last;
    for (int i = 0; i <= kSteps; ++i) {
      const double along = -2 + 4.0 * i / kSteps;
      const HandPose pose{along, slope * along, 1.2 * along, 30 * along};
      const Vec3 now = moved(CarpalGroup::Hand, pose, far_point);
      if (i > 0) {
        EXPECT_LT(distance(now, last), 0.5) << along;
      }
      last = now;
    }
  }
}

TEST(HandMotion, GivesRigidMotionsForAnyInput) {
  Rng rng(3);
  for (int i = 0; i < 500; ++i) {
    const HandPose pose{rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-9, 9),
                        rng.uniform(-900, 900)};
    for (const Motion& m : motion().poses_at(pose)) {
      ASSERT_TRUE(is_finite(m.translation));
      EXPECT_NEAR(m.rotation.determinant(), 1, 1e-12);
      EXPECT_NEAR(length(m.rotation.rows[0]), 1, 1e-12);
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Motion& m : motion().poses_at({nan, nan, nan, nan})) {
    EXPECT_TRUE(is_finite(m.translation));
  }
}

TEST(HandMotion, IsReadWithoutAllocating) {
  const HandMotion& table = motion();
  carpus::test::start_counting_allocations();
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    sum += table.poses_at({0.001 * i, -0.0005 * i, 0.001 * i, 40})[2].translation.x;
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(HandMotion, FlexesTheHandVolarwardsAndTheProximalRowByLess) {
  const HandPose flexed = from_scan(-30, 0);
  const double hand = std::acos((of(CarpalGroup::Hand, flexed).rotation.rows[0].x +
                                 of(CarpalGroup::Hand, flexed).rotation.rows[1].y +
                                 of(CarpalGroup::Hand, flexed).rotation.rows[2].z - 1) /
                                2);
  EXPECT_NEAR(degrees_from_radians(hand), 30, 0.5);
  // Volar is -y, distal -z in the synthetic patient; extension takes fingers to +y.
  const Vec3 finger = middle_of(BoneId::Capitate) + Vec3{0, 0, -40};
  EXPECT_GT(moved(CarpalGroup::Hand, flexed, finger).y, finger.y + 5);
}

TEST(HandMotion, PullsJointsApartAlongTheHandByTractionAsMeasured) {
  HandPose pose = motion().scan;
  pose.traction_n = 98;
  const Vec3 lunate = of(CarpalGroup::Lunate, pose).translation;
  const Vec3 hand = of(CarpalGroup::Hand, pose).translation;
  EXPECT_NEAR(dot(lunate, motion().hand_axis), 1.0, 0.01);         // radiocarpal
  EXPECT_NEAR(dot(hand - lunate, motion().hand_axis), 2.0, 0.01);  // midcarpal
  EXPECT_EQ(of(CarpalGroup::Radius, pose), Motion{});
  EXPECT_LT(length(cross(hand, motion().hand_axis)), 1e-5);
}

TEST(HandMotion, PronatesRadiusAndHandAboutTheUlnaWhichStays) {
  HandPose pose = motion().scan;
  pose.pronation_rad = radians_from_degrees(60);
  EXPECT_EQ(of(CarpalGroup::Ulna, pose), Motion{});
  const Vec3 before = middle_of(BoneId::Radius);
  const Vec3 after = moved(CarpalGroup::Radius, pose, before);
  EXPECT_GT(distance(before, after), 10);
  EXPECT_LT(after.y, before.y);  // over the front (volar, -y) of the ulna
  const auto radius = of(CarpalGroup::Radius, pose);
  const auto hand = of(CarpalGroup::Hand, pose);
  EXPECT_LT(distance(radius.translation, hand.translation), 1e-12);  // as one
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(distance(radius.rotation.rows[i], hand.rotation.rows[i]), 1e-12);
  }
}

TEST(HandMotion, HasThePolynomialsOfCosineAndSine) {
  for (double angle = -kPi / 4; angle <= kPi / 4; angle += 0.001) {
    const CosSin cs = cos_sin_of_small(angle);
    EXPECT_NEAR(cs.cosine, std::cos(angle), 1e-13);
    EXPECT_NEAR(cs.sine, std::sin(angle), 1e-13);
  }
}

TEST(HandMotion, IsTheSameToTheBitInAnyOrderOfItsParts) {
  install_parallel_executor([](std::size_t count, std::size_t grain, const auto& body) {
    const std::size_t parts = (count + grain - 1) / grain;
    for (std::size_t part = parts; part-- > 0;) {
      body(part * grain, std::min(count, (part + 1) * grain));
    }
  });
  const HandMotion backwards = make_hand_motion(wrist());
  install_parallel_executor({});
  EXPECT_TRUE(backwards == motion());
}

TEST(HandMotion, IsMadeOnlyWhereThereIsNone) {
  CaseData data = wrist();
  data.hand_motion.report.scan_overlap_mm = 123;  // a mark
  ensure_hand_motion(data);
  EXPECT_EQ(data.hand_motion.report.scan_overlap_mm, 123);
  data.hand_motion = {};
  ensure_hand_motion(data);
  EXPECT_TRUE(data.hand_motion == motion());
}

TEST(HandMotion, NeedsACapitate) {
  CaseData data = tight_case();
  std::erase_if(data.bones, [](const Bone& bone) { return bone.bone == BoneId::Capitate; });
  EXPECT_THROW((void)make_hand_motion(data), InvalidInput);
}

TEST(HandMotion, MovesBothPartsOfABrokenScaphoidAsOne) {
  CaseData data = tight_case();
  for (Bone& bone : data.bones) {
    if (bone.bone == BoneId::Scaphoid) bone.part = BonePart::Proximal;
  }
  Bone distal = *find_bone(data, BoneId::Scaphoid, BonePart::Proximal);
  distal.part = BonePart::Distal;
  distal.label = kScaphoidDistalLabel;
  data.bones.push_back(distal);  // of the same place: parts do not count as overlapping
  const HandMotion made = make_hand_motion(data);
  EXPECT_EQ(made.report.scan_overlap_mm, motion().report.scan_overlap_mm);
  EXPECT_LE(made.report.overlap_at_nodes_mm, 0.1);
}

}  // namespace
}  // namespace carpus::cases
