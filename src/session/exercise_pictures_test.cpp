// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/exercise_pictures.hpp"

#include <gtest/gtest.h>

#include "simulation/operation_test_support.hpp"

namespace carpus::session {
namespace {

using simulation::test::wrist;

simulation::Snapshot at_opening() {
  return simulation::World(wrist(), simulation::test::exercise(), 1).now();
}

TEST(ExercisePictures, AreOfTheStateAndOfNothingThatWasTakenBefore) {
  const simulation::Snapshot now = at_opening();
  simulation::Snapshot drilled = now;
  const auto& axis = wrist().scaphoid.central_axis;
  drilled.tracks[0] = {simulation::test::body_of(BoneId::Scaphoid), axis.proximal, axis.distal, 1.8,
                       1.8};
  drilled.track_count = 1;
  ExercisePictures pictures(wrist());
  const auto whole = pictures.take({}, now).grey;
  const auto holed = pictures.take({}, drilled).grey;
  EXPECT_NE(holed, whole) << "the hole shows";
  EXPECT_EQ(pictures.take({}, now).grey, whole) << "after an undo it is gone";
}

TEST(ExercisePictures, FollowTheWrist) {
  const simulation::Snapshot now = at_opening();
  simulation::Snapshot moved = now;
  moved.patient_from_bone[simulation::test::body_of(BoneId::Lunate)].translation += Vec3{3, 0, 0};
  ExercisePictures pictures(wrist());
  EXPECT_NE(pictures.take({}, now).grey, pictures.take({}, moved).grey);
}

TEST(ExercisePictures, LiveOnesAreCoarseWhileSomethingMovesAndFullWhenAllRests) {
  simulation::Snapshot now = at_opening();
  ExercisePictures pictures(wrist());
  PictureView view;
  EXPECT_EQ(pictures.take_live(view, now).width, kMovingPixels) << "nothing is known to rest yet";
  EXPECT_EQ(pictures.take_live(view, now).width, 512);
  view.rotation_deg = 5;
  EXPECT_EQ(pictures.take_live(view, now).width, kMovingPixels) << "the C-arm moves";
  now.patient_from_bone[simulation::test::body_of(BoneId::Lunate)].translation += Vec3{1, 0, 0};
  EXPECT_EQ(pictures.take_live(view, now).width, kMovingPixels) << "a bone moves";
  const auto rested = pictures.take_live(view, now);
  EXPECT_EQ(rested.width, 512);
  EXPECT_LT(rested.dose_cgy_cm2 * 49, pictures.take(view, now).dose_cgy_cm2);
}

}  // namespace
}  // namespace carpus::session
