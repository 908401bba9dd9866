// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/composed_projector.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/error.hpp"
#include "fluoroscopy/bone_phantom_test_support.hpp"
#include "fluoroscopy/render.hpp"

namespace carpus::fluoroscopy {
namespace {

using BodyPose = Pose<frame::Patient, frame::Bone>;

constexpr Direction<frame::Wrist> kLeftUlnar{{0, 1, 0}};
constexpr std::array<BodyLabel, 2> kBodies{{{1, 0}, {2, 1}}};

CArmPose c_arm(const ViewAngles& view, int pixels = 128) {
  CArmGeometry geometry;
  geometry.pixels = pixels;
  return make_c_arm_pose(view, {{0, 0, 0}}, {}, kLeftUlnar, geometry);
}

const test::Solid kCube = test::box({-9, 2, 1}, {5, 4, 3});
const test::Solid kBall = test::ball({10, -3, 0}, 6);
const test::Solid kBare = test::ball({0, 0, 0}, -100);  // no limb
const test::Solid kLimb = test::box({0, 0, 0}, {24, 20, 16});
const test::Solid kRoundLimb = test::ball({0, 0, 0}, 26);  // no ray runs along its skin

test::Phantom cube_and_ball(const BodyPose& cube, const BodyPose& ball, const test::Solid& limb) {
  return test::make_phantom(121, 0.5, {test::moved(kCube, cube), test::moved(kBall, ball)}, 1000,
                            limb, 40);
}

/// Largest and mean difference in percent of the oracle's range.
struct Percent {
  double mean = 0;
  double p99 = 0;
  double worst = 0;
};

Percent difference(const AttenuationMap& map, const AttenuationMap& oracle) {
  std::vector<double> all;
  double range = 0;
  double sum = 0;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    EXPECT_EQ(std::isnan(map.values[i]), std::isnan(oracle.values[i]));
    if (std::isnan(oracle.values[i])) continue;
    range = std::max(range, static_cast<double>(oracle.values[i]));
    all.push_back(std::abs(static_cast<double>(map.values[i] - oracle.values[i])));
    sum += all.back();
  }
  std::sort(all.begin(), all.end());
  const auto count = static_cast<double>(all.size());
  return {100 * sum / count / range, 100 * all[static_cast<std::size_t>(0.99 * count)] / range,
          100 * all.back() / range};
}

TEST(ComposedProjector, IsThePlainProjectionWhereNothingMoved) {
  const test::Phantom p = cube_and_ball({}, {}, kRoundLimb);
  const ComposedProjector composed(p.ct.view(), p.labels.view(), kBodies);
  const FluoroscopyRenderer plain(p.ct.view());
  const std::array<BodyPose, 2> still{};
  for (const NamedView& view : kNamedViews) {
    const CArmPose pose = c_arm(view.angles, 256);  // as coarse as any that is taken
    const Percent off = difference(composed.project(pose, still), plain.project(pose, {}));
    // HU is read between voxels before it becomes attenuation, here after: skin's edge differs.
    EXPECT_LT(off.mean, 0.15) << view.id;
    EXPECT_LT(off.p99, 1.4) << view.id;
    EXPECT_LT(off.worst, 2.5) << view.id << ": skin, between pixels";
  }
}

TEST(ComposedProjector, ShowsBodiesMovedInAirAsACtOfThemWouldShowThem) {
  const BodyPose cube{rotation_about({0, 0.6, 0.8}, 0.7), {-2, 5, 3}};
  const BodyPose ball{rotation_about({1, 0, 0}, -1.2), {3, 2, -8}};
  const test::Phantom scanned = cube_and_ball({}, {}, kBare);
  const test::Phantom after = cube_and_ball(cube, ball, kBare);
  const ComposedProjector composed(scanned.ct.view(), scanned.labels.view(), kBodies);
  const FluoroscopyRenderer plain(after.ct.view());
  const std::array<BodyPose, 2> poses{cube, ball};
  for (const NamedView& view : kNamedViews) {
    const CArmPose pose = c_arm(view.angles);
    const Percent off = difference(composed.project(pose, poses), plain.project(pose, {}));
    EXPECT_LT(off.mean, 0.2) << view.id;
    EXPECT_LT(off.p99, 2.5) << view.id << ": edges of the cube, voxels turned against each other";
  }
}

TEST(ComposedProjector, MovesBodiesThroughSoftTissueWithoutATraceOfWhereTheyWere) {
  // Inside a large limb: soft tissue is even, wherever it comes from.
  const test::Solid limb = test::ball({0, 0, 0}, 200);
  const BodyPose cube{rotation_about({0, 0, 1}, 0.5), {-1, 3, 2}};
  const BodyPose ball{{}, {2, 3, -6}};
  const test::Phantom scanned = cube_and_ball({}, {}, limb);
  const test::Phantom after = cube_and_ball(cube, ball, limb);
  const ComposedProjector composed(scanned.ct.view(), scanned.labels.view(), kBodies);
  const ComposedProjector oracle(after.ct.view(), after.labels.view(), kBodies);
  const std::array<BodyPose, 2> poses{cube, ball};
  const std::array<BodyPose, 2> still{};
  const CArmPose pose = c_arm({0, 0});
  const AttenuationMap map = composed.project(pose, poses);
  const AttenuationMap expected = oracle.project(pose, still);
  double worst = 0;
  int seen = 0;
  for (int j = 40; j < 88; ++j) {  // the scan's own ends move with the tissue: keep clear of them
    for (int i = 40; i < 88; ++i) {
      const auto at = static_cast<std::size_t>(j * 128 + i);
      if (std::isnan(map.values[at]) || std::isnan(expected.values[at])) continue;
      ++seen;
      const double bone = 5.0 * attenuation_per_mm(1000);
      const double off = std::abs(static_cast<double>(map.values[at] - expected.values[at])) / bone;
      worst = std::max(worst, off);
    }
  }
  EXPECT_GT(seen, 1000);
  EXPECT_LT(worst, 0.75);
}

TEST(ComposedProjector, KeepsABodysTotalAttenuationHoweverItIsTurned) {
  const test::Phantom p = cube_and_ball({}, {}, kBare);
  const ComposedProjector composed(p.ct.view(), p.labels.view(), kBodies);
  CArmGeometry geometry;  // so far away that rays are parallel
  geometry.source_to_receptor_mm = 1e6;
  geometry.source_to_target_mm = 1e6 - 90;
  geometry.pixels = 256;
  const CArmPose pose = make_c_arm_pose({20, 10}, {{0, 0, 0}}, {}, kLeftUlnar, geometry);
  const auto total = [&](const BodyPose& motion) {
    double sum = 0;
    for (const float v : composed.project_body(0, pose, motion).values) {
      sum += static_cast<double>(v);
    }
    return sum * geometry.pixel_mm() * geometry.pixel_mm();
  };
  const double expected = total({});
  const AttenuationVolume& cube = composed.body(0).volume();
  double mass = 0;
  for (std::size_t i = 0; i < cube.geometry().voxel_count(); ++i) {
    mass += cube.units_at(cube.geometry().index_of(i)) * kAttenuationUnitPerMm *
            cube.geometry().voxel_volume_mm3();
  }
  EXPECT_NEAR(expected, mass, 1e-3 * mass);
  for (int i = 1; i <= 12; ++i) {
    const Mat3 turn = rotation_about({0.48, 0.6, 0.64}, 0.5 * i);
    const Vec3 centre{-9, 2, 1};
    EXPECT_NEAR(total({turn, centre - turn * centre + Vec3{3, 0, 0}}), mass, 1e-3 * mass);
  }
}

TEST(ComposedProjector, TurnsAWholeHandAsTheCArmTurnedTheOtherWay) {
  const test::Phantom p = cube_and_ball({}, {}, kLimb);
  const ComposedProjector composed(p.ct.view(), p.labels.view(), kBodies);
  const BodyPose turned{rotation_about({1, 0, 0}, -0.4), {1, -2, 3}};
  const std::array<BodyPose, 2> poses{turned, turned};
  const std::array<BodyPose, 2> still{};
  const CArmPose pose = c_arm({30, 0});
  CArmPose other = pose;
  other.carm_from_patient = pose.carm_from_patient * Pose<frame::Patient, frame::Patient>{
                                                         turned.rotation, turned.translation};
  const Percent off = difference(composed.project(pose, poses), composed.project(other, still));
  EXPECT_LT(off.worst, 0.01);
}

TEST(ComposedProjector, MatchesSmallStepsThroughTheSameCompositionInABentLimb) {
  const test::Phantom p = cube_and_ball({}, {}, kLimb);
  const ComposedProjector composed(p.ct.view(), p.labels.view(), kBodies);
  const std::array<BodyPose, 2> poses{BodyPose{}, BodyPose{rotation_about({0, 1, 0}, 0.6), {}}};
  const CArmPose pose = c_arm({45, 0}, 64);
  const AttenuationMap map = composed.project(pose, poses);
  const BentTissue tissue(composed.bending(), poses);
  const auto patient_from_carm = pose.carm_from_patient.inverse();
  double sum = 0;
  int rays = 0;
  for (std::size_t j = 4; j < 64; j += 7) {
    for (std::size_t i = 4; i < 64; i += 7) {
      if (std::isnan(map.values[j * 64 + i])) continue;
      const Vec3 way{(static_cast<double>(i) - 31.5) * pose.geometry.pixel_mm(),
                     (static_cast<double>(j) - 31.5) * pose.geometry.pixel_mm(), 450};
      constexpr double kStepMm = 0.05;
      const double slant = length(way) / 450;
      double expected = 0;
      for (double z = -150; z < 0; z += kStepMm / slant) {
        const Vec3 at = way * ((z + 450) / 450) - Vec3{0, 0, 450};
        expected += kStepMm * composed.attenuation_at(patient_from_carm * Point<frame::CArm>{at},
                                                      tissue, poses);
      }
      sum += std::abs(expected - static_cast<double>(map.values[j * 64 + i]));
      ++rays;
    }
  }
  const double range = 2 * 20 * kWaterPerMm + 10 * attenuation_per_mm(1000);
  EXPECT_GT(rays, 30);
  EXPECT_LT(sum / rays / range, 0.005);
}

TEST(ComposedProjector, RefusesPosesThatDoNotMatchItsBodies) {
  const test::Phantom p = cube_and_ball({}, {}, kBare);
  const ComposedProjector composed(p.ct.view(), p.labels.view(), kBodies);
  const std::array<BodyPose, 1> one{};
  EXPECT_THROW((void)composed.project(c_arm({0, 0}), one), InvalidInput);
}

}  // namespace
}  // namespace carpus::fluoroscopy
