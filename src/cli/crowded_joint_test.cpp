// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/crowded_joint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/crowded_joint_scenes.hpp"
#include "core/error.hpp"
#include "procedures/built_in.hpp"

namespace carpus::cli {
namespace {

using simulation::Snapshot;

std::vector<float> about(const std::vector<int>& events, int ticks) {
  TicksAbout course(2, 3);
  for (int i = 0; i < ticks; ++i) {
    course.add(static_cast<float>(i), std::find(events.begin(), events.end(), i) != events.end());
  }
  EXPECT_EQ(course.at(), std::vector<float>(events.begin(), events.end()));
  return course.about();
}

TEST(TicksAbout, KeepsWhatHappenedAndWhatWasNear) {
  EXPECT_EQ(about({5}, 12), (std::vector<float>{3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(about({0}, 12), (std::vector<float>{0, 1, 2, 3}));
  EXPECT_EQ(about({11}, 12), (std::vector<float>{9, 10, 11}));
  EXPECT_TRUE(about({}, 12).empty());
}

TEST(TicksAbout, ATickNearTwoOfThemCountsOnce) {
  EXPECT_EQ(about({3, 5}, 12), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(about({3, 8}, 14), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

TEST(Leaning, PressesUntilItIsHeldAndLetsGoWhereItIsNotWanted) {
  Snapshot now;
  Leaning hand;
  double last = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 by = hand.next(now, 0, {0, 0, 1}, true);
    EXPECT_GE(by.z, last) << "nothing holds it back";
    last = by.z;
  }
  EXPECT_GT(last, 0.5);
  now.hands[0].force_in_patient = {0, 0, -3};
  EXPECT_LT(hand.next(now, 0, {0, 0, 1}, true).z, last) << "pressed more than a light hand does";
  now.hands[0].force_in_patient = {};
  for (int i = 0; i < 200; ++i) last = hand.next(now, 0, {0, 0, 1}, false).z;
  EXPECT_DOUBLE_EQ(last, 0.0);
}

TEST(Leaning, HasABound) {
  const Snapshot free;
  Leaning hand;
  double last = 0.0;
  for (int i = 0; i < 5000; ++i) last = hand.next(free, 1, {1, 0, 0}, true).x;
  EXPECT_DOUBLE_EQ(last, 4.0);
}

TEST(UnsteadyTraction, NeverPullsLessThanIsAskedForAndNeverHoldsStill) {
  double most = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double pull_n = unsteady_traction_n(69.0, i * 1e-3);
    EXPECT_GE(pull_n, 69.0);
    most = std::max(most, pull_n);
  }
  EXPECT_GT(most, 70.0);
  EXPECT_LT(most, 80.0);
}

TEST(CrowdedJoint, ContactIsInAJointByBoneOrByForce) {
  Snapshot now;
  now.hands[0].touching = true;
  EXPECT_FALSE(is_in_contact(now, 0)) << "in no joint";
  now.scope.facts.is_in_joint[0] = true;
  EXPECT_TRUE(is_in_contact(now, 0));
  now.hands[0].touching = false;
  EXPECT_FALSE(is_in_contact(now, 0));
  now.hands[0].force_in_patient = {0, 1, 0};
  EXPECT_TRUE(is_in_contact(now, 0)) << "a wall, or a sheet that yields";
  EXPECT_FALSE(is_in_contact(now, 1)) << "another hand";
}

TEST(CrowdedJoint, TellsTheDiscFromLigaments) {
  Snapshot now;
  EXPECT_FALSE(is_disc_moving(now)) << "there is none";
  now.sheet_count = 3;
  now.sheets[2].is_still = false;
  EXPECT_FALSE(is_disc_moving(now));
  EXPECT_EQ(moving_ligaments(now), 1U);
  now.sheets[0].is_still = false;
  EXPECT_TRUE(is_disc_moving(now));
  EXPECT_EQ(moving_ligaments(now), 1U);
}

const procedure::Procedure& named(const char* id) { return *procedures::built_in().find(id); }

TEST(CrowdedJointScenes, AreOfTrimmingTheDiscAndOfAnExamination) {
  const cases::CaseData none;
  EXPECT_TRUE(time_crowded_joints(none, named("dorsal_scaphoid_fixation"), 10).empty());
  EXPECT_TRUE(time_crowded_joints(none, named("arthroscopic_synovectomy"), 10).empty());
}

TEST(CrowdedJointScenes, ACaseWithoutSoftTissueIsToldWhatToDo) {
  cases::CaseData data;
  data.bones.emplace_back();
  data.bones.back().bone = BoneId::Radius;
  for (const char* id : {"arthroscopic_disc_debridement", "arthroscopic_examination"}) {
    try {
      (void)time_crowded_joints(data, named(id), 10);
      ADD_FAILURE() << id << " began";
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("carpus soft-tissue"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace carpus::cli
