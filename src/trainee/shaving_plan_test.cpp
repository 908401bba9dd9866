// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Scripted hands shave six tufts off the floor of a box of a joint; where a bone hangs over them,
// a shaver does not fit beneath it.
#include <gtest/gtest.h>

#include <utility>

#include "fields/distance_field.hpp"
#include "simulation/tissue_over_box_test_support.hpp"
#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

using namespace simulation::box_joint;  // NOLINT(google-build-using-namespace)

constexpr Tick kLongest = 400'000;
constexpr double kTooLowMm = 0.7;  // for a shaver of 2 mm, and high enough to look beneath
const Vec3 kTufts = kEdge;         // their middle

/// The scope comes level with the tufts, the shaver at right angles to it.
cases::CaseData wrist() {
  cases::ArthroscopicMap map = *box_wrist().arthroscopy;
  cases::Portal& scope = map.portals.front();
  scope.skin = kTufts + Vec3{kHalf + scope.capsule_mm, 0, 1};
  cases::Portal shaver = scope;
  shaver.number = 1;
  shaver.skin = kTufts + Vec3{0, kHalf - 4.5 + scope.capsule_mm, 2};
  shaver.inwards = {0, -1, 0};
  map.portals.push_back(shaver);
  map.points.front().is_probed = false;
  map.points.front().by = {0};
  return box_wrist_with(std::move(map));
}

cases::CaseData wrist_with_low_bone() {
  cases::CaseData made = wrist();
  TriangleMesh mesh;
  for (const double z : {kTooLowMm, 3.0}) {
    for (const double y : {-5.0, 5.0}) {
      for (const double x : {-5.0, 5.0}) mesh.vertices.push_back(kTufts + Vec3{x, y, z});
    }
  }
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  cases::Bone& bone = made.bones[simulation::test::body_of(BoneId::Lunate)];
  static_cast<TriangleMesh&>(bone.surface) = mesh;
  bone.distance_field = fields::build_distance_field(bone.surface, {0.25, 4.0});
  return made;
}

procedure::ShavingFacts shaved(const cases::CaseData& data, Skill skill) {
  const procedure::Procedure procedure = inflamed_with({"arthroscope_1_9_30", "shaver_2_0"});
  simulation::World world(data, procedure, 1);
  world.leave_out_hashes();
  ScriptedArthroscopist hands(data, procedure, skill, 1);
  hands.examines(world.lesions());
  while (!world.now().finished && world.now().tick < kLongest) world.step(hands.next(world.now()));
  EXPECT_TRUE(world.now().finished);
  return world.operation_record().scope->facts.shaving;
}

TEST(ShavingPlan, AnExpertPressesThePedalAtTheTissueAlone) {
  const procedure::ShavingFacts done = shaved(wrist(), Skill::Expert);
  EXPECT_EQ(done.ill_removed, done.ill);
  EXPECT_GT(done.running_ticks, 0U);
  EXPECT_LT(done.running_ticks, 6000U) << "a second a tuft";
  EXPECT_EQ(done.cartilage_ticks + done.lining_ticks, 0U);
  EXPECT_EQ(done.way_ticks, 0U);
}

TEST(ShavingPlan, WhatDoesNotComeIntoTheMouthIsGivenUpWithoutThePedal) {
  const cases::CaseData data = wrist_with_low_bone();
  const procedure::ShavingFacts done = shaved(data, Skill::Expert);
  EXPECT_NE(done.patches_seen, 0) << "it was seen";
  EXPECT_EQ(done.ill_removed, 0);
  EXPECT_EQ(done.running_ticks, 0U);
  EXPECT_GT(shaved(data, Skill::Novice).running_ticks, 3000U) << "a hasty foot presses";
}

}  // namespace
}  // namespace carpus::trainee
