// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/c_arm.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr double kRoundingPx = 1e-6;
constexpr Direction<frame::Wrist> kLeftUlnar{{0, 1, 0}};
constexpr Direction<frame::Wrist> kRightUlnar{{0, -1, 0}};

/// Some place of the wrist in the scanner.
Pose<frame::Wrist, frame::Patient> placed(Rng& rng) {
  const Mat3 rotation = rotation_from_quaternion(rng.uniform(0.2, 1), rng.uniform(-1, 1),
                                                 rng.uniform(-1, 1), rng.uniform(-1, 1));
  return {rotation, {rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-50, 50)}};
}

PixelPosition at(const CArmPose& pose, const Vec3& point) {
  return project_point(pose, {point}).value();
}

TEST(CArm, ShowsALeftHandFromDorsalWithFingersUpAndThumbToTheRight) {
  const Pose<frame::Wrist, frame::Patient> wrist;
  const CArmPose pa = make_c_arm_pose({0, 0}, {{0, 0, 0}}, wrist, kLeftUlnar);
  EXPECT_LT(pa.source_in_patient().v.z, 0) << "PA: the source is dorsal, -z of the wrist";
  EXPECT_LT(at(pa, {-10, 0, 0}).y, at(pa, {10, 0, 0}).y) << "distal is above proximal";
  EXPECT_GT(at(pa, {0, -10, 0}).x, at(pa, {0, 10, 0}).x) << "radial, -y on a left wrist, is right";
}

TEST(CArm, TurnsTheSourceFromDorsalOverRadialForPositiveRotationOfEitherSide) {
  const Pose<frame::Wrist, frame::Patient> wrist;
  const auto source = [&](double degrees, const Direction<frame::Wrist>& ulnar) {
    return make_c_arm_pose({degrees, 0}, {{0, 0, 0}}, wrist, ulnar).source_in_patient().v;
  };
  EXPECT_NEAR(source(90, kLeftUlnar).y, -360, 1e-9);
  EXPECT_NEAR(source(90, kRightUlnar).y, 360, 1e-9);
  EXPECT_NEAR(source(180, kLeftUlnar).z, 360, 1e-9) << "AP: the source is volar";
}

TEST(CArm, TiltsTheSourceTowardsProximal) {
  const CArmPose pose = make_c_arm_pose({0, 30}, {{0, 0, 0}}, {}, kLeftUlnar);
  EXPECT_NEAR(pose.source_in_patient().v.x, 180, 1e-9);
}

TEST(CArm, NamesObliquesByForearmRotationFromNeutral) {
  // 60 degrees pronated from lateral is nearer to PA than 45 degrees; supinated and pronated
  // obliques of one angle lie at equal angles to the lateral, on different lines of sight.
  EXPECT_EQ(find_view("oblique_60_pronated")->angles.rotation_deg, 90.0 - 60.0);
  EXPECT_EQ(find_view("oblique_45_pronated")->angles.rotation_deg, 90.0 - 45.0);
  EXPECT_EQ(find_view("oblique_45_supinated")->angles.rotation_deg, 90.0 + 45.0 - 180.0);
  EXPECT_FALSE(find_view("oblique_46_pronated").has_value());
}

RC_GTEST_PROP(CArm, ProjectsTheTargetToTheCentreFromEveryView, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const ViewAngles view{rng.uniform(-180, 180), rng.uniform(-60, 60)};
  const Vec3 target{rng.uniform(-80, 80), rng.uniform(-80, 80), rng.uniform(-80, 80)};
  const CArmPose pose = make_c_arm_pose(view, {target}, placed(rng), kRightUlnar);
  const PixelPosition p = at(pose, target);
  RC_ASSERT(std::abs(p.x - 255.5) < kRoundingPx && std::abs(p.y - 255.5) < kRoundingPx);
  RC_ASSERT(std::abs(pose.carm_from_patient.rotation.determinant() - 1) < 1e-9);
  RC_ASSERT(std::abs(distance(pose.source_in_patient().v, target) - 360) < 1e-6);
}

RC_GTEST_PROP(CArm, GivesMirrorPicturesOfMirrorHands, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const ViewAngles view{rng.uniform(-180, 180), rng.uniform(-60, 60)};
  const CArmPose left = make_c_arm_pose(view, {{0, 0, 0}}, {}, kLeftUlnar);
  const CArmPose right = make_c_arm_pose(view, {{0, 0, 0}}, {}, kRightUlnar);
  const Vec3 p{rng.uniform(-40, 40), rng.uniform(-40, 40), rng.uniform(-40, 40)};
  const PixelPosition a = at(left, p);
  const PixelPosition b = at(right, {p.x, -p.y, p.z});
  RC_ASSERT(std::abs(a.x + b.x - 511) < kRoundingPx);
  RC_ASSERT(std::abs(a.y - b.y) < kRoundingPx);
}

RC_GTEST_PROP(CArm, FindsAPointAgainFromPaAndLateral, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  const Pose<frame::Wrist, frame::Patient> wrist = placed(rng);
  const Vec3 point{rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-30, 30)};
  // The ray of a pixel: from the source through the receptor.
  const auto ray = [&](const CArmPose& pose, Vec3& from, Vec3& along) {
    const PixelPosition p = at(pose, point);
    const double pixel = pose.geometry.pixel_mm();
    const Point<frame::CArm> hit{{(p.x - 255.5) * pixel, (p.y - 255.5) * pixel, 0}};
    from = pose.source_in_patient().v;
    along = normalized_or((pose.carm_from_patient.inverse() * hit).v - from, {});
  };
  Vec3 p, u, q, v;
  ray(make_c_arm_pose({0, 0}, {{0, 0, 0}}, wrist, kLeftUlnar), p, u);
  ray(make_c_arm_pose({90, 0}, {{0, 0, 0}}, wrist, kLeftUlnar), q, v);
  // Nearest point of two lines.
  const double uv = dot(u, v);
  const double s = (dot(q - p, u) - uv * dot(q - p, v)) / (1 - uv * uv);
  RC_ASSERT(distance(p + u * s, point) < 1e-6);
}

TEST(CArm, HasNoPictureOfWhatIsBehindTheSource) {
  const CArmPose pose = make_c_arm_pose({0, 0}, {{0, 0, 0}}, {}, kLeftUlnar);
  EXPECT_FALSE(project_point(pose, {{0, 0, -361}}).has_value());
  EXPECT_TRUE(project_point(pose, {{0, 0, -359}}).has_value());
}

TEST(CArm, RefusesAnglesAndGeometryThatMakeNoPicture) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto make = [](const ViewAngles& view, const CArmGeometry& geometry) {
    return make_c_arm_pose(view, {{0, 0, 0}}, {}, kLeftUlnar, geometry);
  };
  EXPECT_THROW((void)make({nan, 0}, {}), InvalidInput);
  EXPECT_THROW((void)make({0, nan}, {}), InvalidInput);
  EXPECT_THROW((void)make({0, 81}, {}), InvalidInput);
  EXPECT_THROW((void)make({0, 0}, {450, 450, 100, 512}), InvalidInput);
  EXPECT_THROW((void)make({0, 0}, {450, 360, 0, 512}), InvalidInput);
  EXPECT_THROW((void)make({0, 0}, {450, 360, 100, 0}), InvalidInput);
}

}  // namespace
}  // namespace carpus::fluoroscopy
