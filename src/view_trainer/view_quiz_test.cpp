// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/view_quiz.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "view_trainer/screw_test_support.hpp"

namespace carpus::view_trainer {
namespace {

using protocol::ScrewPlace;

ViewQuiz& quiz() {
  static ViewQuiz one(test::wrist());
  return one;
}

TEST(ViewQuiz, AsksInOrderAndTellsTheTruthOnlyForAnAnswer) {
  ViewQuiz& q = quiz();
  q.begin(7);
  EXPECT_FALSE(q.look("pa").has_value()) << "nothing is asked yet";
  EXPECT_FALSE(q.answer({ScrewPlace::Inside, "skyline"}).has_value());
  const auto question = q.next();
  ASSERT_TRUE(question.has_value());
  EXPECT_EQ(question->number, 1);
  EXPECT_EQ(question->views.size(), standard_views().size());
  EXPECT_FALSE(q.next().has_value()) << "the first is not answered";
  const auto first = q.look(question->first_view);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->image.width, 512);
  EXPECT_FALSE(q.look("upside_down").has_value());
  EXPECT_FALSE(q.answer({ScrewPlace::Inside, question->first_view}).has_value())
      << "it is no next view";
  const auto truth = q.answer({ScrewPlace::Inside, "skyline"});
  ASSERT_TRUE(truth.has_value());
  EXPECT_FALSE(q.answer({ScrewPlace::Side, "skyline"}).has_value()) << "the first answer counts";
  EXPECT_EQ(truth->tally.answers, 1);
  EXPECT_EQ(truth->tally.views_taken, 1);
  ASSERT_TRUE(q.look("skyline").has_value());
  const auto next = q.next();
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(next->tally.views_taken, 1) << "looks after the answer are free";
}

TEST(ViewQuiz, GradesByTheTruthAndCountsFalseSafetyApart) {
  ViewQuiz& q = quiz();
  q.begin(11);
  int outs = 0;
  for (int i = 1; i <= 6; ++i) {
    ASSERT_TRUE(q.next().has_value());
    const auto truth = q.answer({ScrewPlace::Inside, "oblique_45_pronated"});
    ASSERT_TRUE(truth.has_value());
    const bool is_out = truth->place != ScrewPlace::Inside;
    if (is_out) ++outs;
    EXPECT_EQ(truth->is_place_right, !is_out);
    EXPECT_EQ(truth->is_false_safety, is_out);
    EXPECT_EQ(is_out, truth->depth_mm > kOutMm);
    EXPECT_EQ(truth->tally.false_safety, outs);
    EXPECT_EQ(truth->tally.right_places, i - outs);
    for (const auto& view : truth->views) {
      EXPECT_EQ(view.reveals, view.overhang_mm >= truth->revealed_mm);
      EXPECT_GE(view.bone.size(), 1U);
      EXPECT_GT(view.screw.pixels.size(), 20U);
      EXPECT_LE(view.bone.front().pixels.size(), 1024U);
    }
    const auto best = std::max_element(
        truth->views.begin(), truth->views.end(),
        [](const auto& a, const auto& b) { return a.overhang_mm < b.overhang_mm; });
    if (is_out) {
      EXPECT_EQ(truth->best_view, best->view);
      EXPECT_TRUE(best->reveals) << "what no view shows is not asked";
    }
  }
}

TEST(ViewQuiz, BestViewIsARightAnswerAndTheSameSeedAsksTheSame) {
  ViewQuiz& q = quiz();
  for (int i = 0; i < 2; ++i) {
    q.begin(23);
    ASSERT_TRUE(q.next().has_value());
    const auto told = q.answer({ScrewPlace::Distal, "pa"});
    ASSERT_TRUE(told.has_value());
    q.begin(23);
    ASSERT_TRUE(q.next().has_value());
    const auto right = q.answer({told->place, told->best_view});
    ASSERT_TRUE(right.has_value());
    EXPECT_TRUE(right->is_place_right);
    EXPECT_TRUE(right->is_view_right);
    EXPECT_FALSE(right->is_false_safety);
    EXPECT_EQ(right->depth_mm, told->depth_mm);
  }
}

}  // namespace
}  // namespace carpus::view_trainer
