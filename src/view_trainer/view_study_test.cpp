// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/view_study.hpp"

#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "view_trainer/screw_test_support.hpp"
#include "view_trainer/silhouette.hpp"

namespace carpus::view_trainer {
namespace {

const ScaphoidSurface& surface() {
  static const ScaphoidSurface one(test::wrist());
  return one;
}

const StudiedCase& studied() {
  static const StudiedCase one = study_case(test::wrist(), 0, 1, 8);
  return one;
}

TEST(GeneratedScrew, IsOutAsFarAsWantedOrWhollyInAndTheSameForASeed) {
  int out = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const GeneratedScrew made = generate_screw(surface(), seed);
    EXPECT_EQ(made.placed.instrument().work, instruments::Work::Thread);
    EXPECT_TRUE(made.truth.depth_mm <= 0 || made.is_out()) << seed;
    EXPECT_LE(made.truth.depth_mm, kFarthestOutMm + 0.11);
    EXPECT_NEAR(made.truth.depth_mm, test::deepest_by_brute_force(surface(), made.placed), 0.02);
    if (made.is_out()) ++out;
  }
  EXPECT_GT(out, 0);
  EXPECT_LT(out, 6);
  EXPECT_EQ(generate_screw(surface(), 3).placed.tip, generate_screw(surface(), 3).placed.tip);
}

TEST(ViewStudy, NoViewRevealsMoreThanThereIsAndNoneOfWhatIsInside) {
  for (const StudiedScrew& screw : studied().screws) {
    for (const Overhang& overhang : screw.overhangs) {
      EXPECT_LE(overhang.true_mm, std::max(0.0, screw.truth.depth_mm) * 1.05 + 0.06);
    }
  }
  for (const auto& views : view_sets()) {
    const StudyRow row = row_of(studied().screws, views, Reading::OfTheTruth);
    ASSERT_TRUE(row.specificity.has_value());
    EXPECT_EQ(*row.specificity, 1.0);
    EXPECT_EQ(row.screws, 8U);
  }
}

TEST(ViewStudy, MoreViewsRevealNoLessAndAreNoMoreSpecific) {
  const auto& screws = studied().screws;
  for (const Reading reading : {Reading::OnThePicture, Reading::OfTheTruth}) {
    const auto sets = view_sets();
    const StudyRow all = row_of(screws, sets.back(), reading);
    for (const auto& views : sets) {
      const StudyRow row = row_of(screws, views, reading);
      EXPECT_LE(*row.sensitivity, *all.sensitivity);
      EXPECT_GE(*row.specificity, *all.specificity);
    }
  }
}

TEST(ViewStudy, RowsCountAsTheirDefinitionSays) {
  StudiedScrew out_and_seen;
  out_and_seen.truth.depth_mm = 1.0;
  out_and_seen.overhangs = {{0.6, 0.1}, {0.1, 0.6}};
  StudiedScrew out_and_missed = out_and_seen;
  out_and_missed.overhangs = {{0.4, 0.4}, {0.4, 0.4}};
  StudiedScrew in_and_accused;
  in_and_accused.truth.depth_mm = -1.0;
  in_and_accused.overhangs = {{-0.5, 0.7}, {-0.5, 0.0}};
  const std::vector<StudiedScrew> screws{out_and_seen, out_and_missed, in_and_accused};
  const StudyRow first = row_of(screws, {0}, Reading::OnThePicture);
  EXPECT_EQ(first.sensitivity, 0.0);
  EXPECT_EQ(first.specificity, 0.0);
  const StudyRow both = row_of(screws, {0, 1}, Reading::OnThePicture);
  EXPECT_EQ(both.sensitivity, 0.5);
  const StudyRow truth = row_of(screws, {0}, Reading::OfTheTruth);
  EXPECT_EQ(truth.sensitivity, 0.5);
  EXPECT_EQ(truth.specificity, 1.0);
  EXPECT_FALSE(row_of(screws, {0}, Reading::OfTheTruth, Region::Distal).sensitivity.has_value());
  EXPECT_EQ(limit_that_misses_half(screws, {0, 1}, Reading::OfTheTruth, Region::Side), 0.6);
  EXPECT_FALSE(
      limit_that_misses_half(screws, {0}, Reading::OfTheTruth, Region::Distal).has_value());
}

TEST(OutlineReader, FindsTheEdgeOfADiscInNoise) {
  OutlineMap truth({{60, 60}, 400, 400, 0.125});
  truth.add_disc({160, 160}, 60);
  truth.finish();
  fluoroscopy::Image picture{320, 320, std::vector<std::uint8_t>(320 * 320, 0), 0.156, 0};
  Rng rng(3);
  for (int y = 0; y < 320; ++y) {
    for (int x = 0; x < 320; ++x) {
      const double edge = std::clamp((std::hypot(x - 160.0, y - 160.0) - 60.0) / 3.0, -1.0, 1.0);
      picture.grey[static_cast<std::size_t>(y * 320 + x)] =
          static_cast<std::uint8_t>(120 + 30 * edge + 4 * rng.normal());
    }
  }
  const ReadingError error = reading_error(read_outline(picture, truth), truth);
  EXPECT_NEAR(error.mean_mm, 0.0, 0.08);
  EXPECT_LT(error.deviation_mm, 0.15);
}

TEST(StandardViews, AreTheNamedOnesAndKnowOnlyThose) {
  ASSERT_EQ(standard_views().size(), fluoroscopy::kNamedViews.size());
  for (std::size_t i = 0; i < standard_views().size(); ++i) {
    EXPECT_EQ(standard_views()[i].id, fluoroscopy::kNamedViews[i].id);
  }
  EXPECT_THROW((void)view_index("upside_down"), std::exception);
}

}  // namespace
}  // namespace carpus::view_trainer
