// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/exercise_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// Mean difference of neighbours in a row: noise, for bones are the same in both.
double roughness(const fluoroscopy::Image& image) {
  double sum = 0;
  for (std::size_t i = 1; i < image.grey.size(); ++i) {
    sum += std::abs(static_cast<double>(image.grey[i]) - image.grey[i - 1]);
  }
  return sum / static_cast<double>(image.grey.size() - 1);
}

TEST(ExercisePictures, TheTubeChangesNoiseAndWhatStandsOut) {
  simulation::Snapshot now = at_opening();
  ExercisePictures pictures(wrist());
  const auto usual = pictures.take({}, now);
  now.tube = 3;  // 60 kV, low
  const auto low = pictures.take({}, now);
  EXPECT_NEAR(low.dose_cgy_cm2, usual.dose_cgy_cm2 / 2, 1e-9);
  EXPECT_GT(roughness(low), 1.2 * roughness(usual));
  now.tube = 1;  // 50 kV
  EXPECT_NE(pictures.take({}, now).grey, usual.grey);
  now.tube = procedure::kUsualTube;
  EXPECT_EQ(pictures.take({}, now).grey, usual.grey) << "nothing of it is kept";
}

TEST(ExercisePictures, TheHeldPictureIsNoCheapShot) {
  const simulation::Snapshot now = at_opening();
  ExercisePictures pictures(wrist());
  const PictureView view;
  const auto held = pictures.take_held(view, now);
  const auto shot = pictures.take(view, now);
  EXPECT_EQ(held.width, shot.width);
  EXPECT_NEAR(held.dose_cgy_cm2 * procedure::kPulsesPerShot, shot.dose_cgy_cm2, 1e-9);
  EXPECT_GT(roughness(held), 1.5 * roughness(shot)) << "a quarter of the quanta";
}

}  // namespace
}  // namespace carpus::session
