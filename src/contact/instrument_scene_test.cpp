// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/instrument_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/allocation_test_support.hpp"
#include "core/amount_test_support.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using carpus::test::amount;
using BonePose = Pose<frame::Patient, frame::Bone>;
using ToolPose = Pose<frame::Patient, frame::Tool>;

std::vector<InstrumentShape> instruments() {
  return {InstrumentShape(SphereShape{1.5}), InstrumentShape(CapsuleShape{1.0, 60}),
          InstrumentShape(ConeTipShape{0.57, 1.5, 80}),
          InstrumentShape(ThreadedCylinderShape{1.0, 1.5, 0.8, 16})};
}

const std::vector<fields::ContactField>& bones() {
  static const std::vector<fields::ContactField> kBones = [] {
    std::vector<fields::ContactField> fields;
    for (const TriangleMesh& mesh :
         {fields::test::torus(8, 3, 24), fields::test::bowl(24), fields::test::box({6, 5, 4})}) {
      fields.emplace_back(fields::build_distance_field(mesh, {.spacing_mm = 0.6, .band_mm = 4}),
                          mesh);
    }
    return fields;
  }();
  return kBones;
}

/// Bones beside each other and instruments among them, all of which wander and turn.
struct Wandering {
  explicit Wandering(std::uint64_t seed) : rng(seed) {
    for (std::size_t b = 0; b < bones().size(); ++b) {
      bone_poses.push_back({Mat3::identity(), {18.0 * static_cast<double>(b) - 18, 0, 0}});
    }
    for (std::size_t i = 0; i < instruments().size(); ++i) {
      const Vec3 tip{rng.uniform(-25, 25), rng.uniform(-8, 8), rng.uniform(0, 12)};
      tool_poses.push_back({fields::test::turned_to(fields::test::random_direction(rng)), tip});
    }
  }
  void step(double way_mm, double angle_rad) {
    for (auto& pose : bone_poses) move(pose, way_mm, angle_rad);
    for (auto& pose : tool_poses) move(pose, way_mm, angle_rad);
  }
  template <typename P>
  void move(P& pose, double way_mm, double angle_rad) {
    const Vec3 axis = fields::test::random_direction(rng);
    const Mat3 turn = rotation_about(axis, rng.uniform(0, angle_rad));
    pose.rotation = turn * pose.rotation;
    pose.translation += fields::test::random_shift(rng, way_mm) -
                        pose.translation * (0.001 * way_mm);  // so that they stay together
  }
  Rng rng;
  std::vector<BonePose> bone_poses;
  std::vector<ToolPose> tool_poses;
};

bool are_equal(const SurfaceContact& a, const SurfaceContact& b) {
  bool equal = a.outcome == b.outcome && a.gap_mm == b.gap_mm &&
               a.lowest_gap_mm == b.lowest_gap_mm && a.highest_gap_mm == b.highest_gap_mm &&
               a.z_mm == b.z_mm && a.point == b.point && a.normal == b.normal &&
               a.steepness == b.steepness && a.patch.length_mm == b.patch.length_mm &&
               a.patch.area_mm2 == b.patch.area_mm2 && a.patch.centre_z_mm == b.patch.centre_z_mm &&
               a.patch.core_length_mm == b.patch.core_length_mm &&
               a.patch.stretch_count == b.patch.stretch_count;
  for (std::size_t s = 0; equal && s < a.patch.stretch_count; ++s) {
    const ContactStretch& x = a.patch.stretches[s];
    const ContactStretch& y = b.patch.stretches[s];
    equal = x.from_mm == y.from_mm && x.to_mm == y.to_mm && x.depth_mm == y.depth_mm &&
            x.point == y.point && x.normal == y.normal;
  }
  return equal;
}

/// Pairs on which the two scenes differ in any bit.
int count_differences(const InstrumentScene& a, const InstrumentScene& b) {
  int different = 0;
  for (std::size_t i = 0; i < a.instrument_count(); ++i) {
    for (std::size_t j = 0; j < a.bone_count(); ++j) {
      different += are_equal(a.contact(i, j), b.contact(i, j)) ? 0 : 1;
    }
  }
  const bool same_alerts =
      std::equal(a.alerts().begin(), a.alerts().end(), b.alerts().begin(), b.alerts().end());
  return different + (same_alerts ? 0 : 1);
}

TEST(InstrumentScene, AnswersAlongATrajectoryAsFromScratch) {
  for (const double within : {0.0, 0.8}) {
    Wandering wandering(1);
    const InstrumentSceneOptions options{.within_mm = within, .look_ahead_mm = 1.0};
    InstrumentScene warm(bones(), instruments(), options);
    InstrumentScene scratch(bones(), instruments(), options);
    std::size_t alerts = 0;
    for (int tick = 0; tick < amount(200, 1500, 50000); ++tick) {
      // Mostly small steps, now and then a jump.
      wandering.step(tick % 50 == 49 ? 3.0 : 0.05, tick % 50 == 49 ? 0.3 : 0.002);
      scratch.forget();
      warm.update(wandering.bone_poses, wandering.tool_poses);
      scratch.update(wandering.bone_poses, wandering.tool_poses);
      ASSERT_EQ(count_differences(warm, scratch), 0) << tick;
      alerts += warm.alerts().size();
    }
    EXPECT_GT(alerts, 100U);
    EXPECT_EQ(scratch.counts().left_alone, 0U);
    EXPECT_GT(warm.counts().left_alone, warm.counts().pairs / 4);
    EXPECT_EQ(warm.counts().pairs,
              warm.counts().left_alone + warm.counts().by_bounds + warm.counts().by_field);
  }
}

TEST(InstrumentScene, AnswersAsThePairAlone) {
  Wandering wandering(2);
  InstrumentScene scene(bones(), instruments());
  for (int tick = 0; tick < amount(100, 500, 20000); ++tick) {
    wandering.step(1.0, 0.1);
    scene.update(wandering.bone_poses, wandering.tool_poses);
    for (std::size_t i = 0; i < scene.instrument_count(); ++i) {
      for (std::size_t b = 0; b < scene.bone_count(); ++b) {
        const auto bone_from_tool = wandering.bone_poses[b].inverse() * wandering.tool_poses[i];
        const SurfaceContact alone = find_contact(bones()[b], instruments()[i], bone_from_tool);
        ASSERT_EQ(scene.contact(i, b).has_contact(), alone.has_contact());
        ASSERT_NEAR(scene.contact(i, b).gap_mm, alone.gap_mm, 1e-6);
      }
    }
  }
}

TEST(InstrumentScene, LeavesDistantPairsAloneUntilTheyHaveMovedFar) {
  InstrumentScene scene(bones(), {InstrumentShape(SphereShape{1.0})});
  std::vector<BonePose> bone_poses(bones().size());
  for (std::size_t b = 0; b < bones().size(); ++b) {
    bone_poses[b].translation = {100.0 * static_cast<double>(b), 0, 0};
  }
  std::vector<ToolPose> tool_poses(1);
  tool_poses[0].translation = {0, 0, 60};
  scene.update(bone_poses, tool_poses);
  EXPECT_EQ(scene.counts().by_bounds, bones().size());
  for (int tick = 0; tick < 100; ++tick) {  // 30 mm nearer, still far
    tool_poses[0].translation.z -= 0.3;
    scene.update(bone_poses, tool_poses);
  }
  EXPECT_EQ(scene.counts().by_bounds, bones().size());
  EXPECT_EQ(scene.counts().left_alone, 100 * bones().size());
  tool_poses[0].translation = {8, 0, 2.9};  // on the ring
  scene.update(bone_poses, tool_poses);
  ASSERT_EQ(scene.alerts().size(), 1U);
  EXPECT_EQ(scene.alerts()[0], (InstrumentBonePair{0, 0}));
  EXPECT_NEAR(scene.contact(0, 0).depth_mm(), 0.1, 0.05);
}

TEST(InstrumentScene, NamesPosesThatAreNotFiniteAndRecovers) {
  Wandering wandering(3);
  InstrumentScene scene(bones(), instruments());
  InstrumentScene other(bones(), instruments());
  scene.update(wandering.bone_poses, wandering.tool_poses);
  std::vector<ToolPose> broken = wandering.tool_poses;
  broken[1].rotation.rows[2].x = std::numeric_limits<double>::quiet_NaN();
  scene.update(wandering.bone_poses, broken);
  std::size_t not_known = 0;
  for (const InstrumentBonePair& pair : scene.alerts()) {
    if (scene.contact(pair.instrument, pair.bone).outcome != ContactOutcome::NotKnown) continue;
    EXPECT_EQ(pair.instrument, 1U);
    ++not_known;
  }
  EXPECT_EQ(not_known, bones().size());
  EXPECT_EQ(scene.counts().not_known, bones().size());
  scene.update(wandering.bone_poses, wandering.tool_poses);
  other.update(wandering.bone_poses, wandering.tool_poses);
  EXPECT_EQ(count_differences(scene, other), 0);
}

TEST(InstrumentScene, AllocatesNothing) {
  Wandering wandering(4);
  InstrumentScene scene(bones(), instruments());
  carpus::test::start_counting_allocations();
  for (int tick = 0; tick < 300; ++tick) {
    for (auto& pose : wandering.tool_poses) wandering.move(pose, 0.5, 0.05);
    scene.update(wandering.bone_poses, wandering.tool_poses);
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_GT(scene.counts().by_field, 0U);
}

TEST(InstrumentScene, RefusesWhatItCannotServe) {
  EXPECT_THROW(InstrumentScene({}, instruments()), InvalidInput);
  EXPECT_THROW(InstrumentScene(bones(), {}), InvalidInput);
  EXPECT_THROW(InstrumentScene(bones(), {InstrumentShape(SphereShape{5})}), InvalidInput);
  EXPECT_THROW(InstrumentScene(bones(), instruments(), {.within_mm = -1}), InvalidInput);
  EXPECT_THROW(InstrumentScene(bones(), instruments(), {.within_mm = 3}), InvalidInput);
  EXPECT_THROW(InstrumentScene(bones(), instruments(),
                               {.look_ahead_mm = std::numeric_limits<double>::quiet_NaN()}),
               InvalidInput);
}

}  // namespace
}  // namespace carpus::contact
