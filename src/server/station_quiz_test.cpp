// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The view quiz through a real socket: it asks before it tells, and what was answered is kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/station_test_support.hpp"

namespace carpus::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;
using namespace testing;

TEST_F(StationTest, QuizAsksShowsAndTellsTheTruthOnlyAfterTheAnswer) {
  PageClient page(port());
  page.send(kHello);
  (void)page.wait_for_type("welcome");
  page.send(R"({"type":"quiz_next"})");
  EXPECT_THAT(page.wait_for_type("error", 20s), HasSubstr("Another page's quiz"));
  page.send(R"({"type":"quiz_begin","trainee":"Ada","seed":7})");
  const std::string question = page.wait_for_type("quiz_question", 20s);
  for (const char* secret : {"depth", "overhang", "best", "towards", "pixels", "is_"}) {
    EXPECT_THAT(question, Not(HasSubstr(secret)));
  }
  const auto picture = page.wait_for([](const auto& f) { return f.is_binary; }, 20s);
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->content.size(), 40U + 512U * 512U);
  EXPECT_EQ(picture->content[8], 3) << "a picture of the quiz";
  page.send(R"({"type":"quiz_look","view":"skyline"})");
  ASSERT_TRUE(page.wait_for([](const auto& f) { return f.is_binary; }, 20s).has_value());
  page.send(R"({"type":"quiz_answer","place":"inside","next_view":"oblique_45_pronated"})");
  const Json truth = Json::parse(page.wait_for_type("quiz_truth", 20s));
  EXPECT_EQ(truth["is_place_right"], truth["place"] == "inside");
  EXPECT_EQ(truth["views"].size(), Json::parse(question)["views"].size());
  EXPECT_EQ(truth["tally"]["views_taken"], 2);
  page.send(R"({"type":"quiz_answer","place":"side","next_view":"pa"})");
  EXPECT_THAT(page.wait_for_type("error", 20s), HasSubstr("answered already"));
}

TEST_F(StationTest, QuizAnswersAreKeptWithTheTraineesName) {
  PageClient page(port());
  page.send(kHello);
  (void)page.wait_for_type("welcome");
  page.send("{\"type\":\"quiz_begin\",\"trainee\":\"A\u202ea\",\"seed\":7}");
  EXPECT_THAT(page.wait_for_type("error"), HasSubstr("U+202E"));
  page.send(R"({"type":"quiz_begin","trainee":"Ada","seed":7})");
  (void)page.wait_for_type("quiz_question", 20s);
  page.send(R"({"type":"quiz_answer","place":"inside","next_view":"oblique_45_pronated"})");
  const Json first = Json::parse(page.wait_for_type("quiz_truth", 20s));
  page.send(R"({"type":"quiz_next"})");
  (void)page.wait_for_type("quiz_question", 20s);
  page.send(R"({"type":"quiz_look","view":"skyline"})");
  page.send(R"({"type":"quiz_answer","place":"distal","next_view":"oblique_45_pronated"})");
  const Json second = Json::parse(page.wait_for_type("quiz_truth", 20s));
  page.vanish();
  (void)records_->settle();
  const Json kept = Json::parse(request(port(), "/api/quiz_answers").body())["answers"];
  ASSERT_EQ(kept.size(), 2U);
  for (const auto& [answer, truth] : {std::pair(kept[1], first), std::pair(kept[0], second)}) {
    EXPECT_EQ(answer["trainee"], "Ada");
    EXPECT_EQ(answer["case"], wrist().pseudonym);
    EXPECT_EQ(answer["seed"], 7);
    for (const char* same : {"number", "place", "depth_mm", "answered", "next_view",
                             "is_place_right", "is_view_right", "is_false_safety"}) {
      EXPECT_EQ(answer[same], truth[same]) << same;
    }
  }
  EXPECT_EQ(kept[1]["views_taken"], 1);
  EXPECT_EQ(kept[0]["views_taken"], 2) << "of its own question alone";
}

TEST_F(StationTest, QuizLeavesTheExerciseAlone) {
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->send(R"({"type":"quiz_begin","trainee":"Ada","seed":7})");
  EXPECT_THAT(page->wait_for_type("quiz_question", 20s), HasSubstr("\"number\":1,"));
  page->send(R"({"type":"act","id":"finish"})");
  EXPECT_EQ(Json::parse(page->wait_for_type("score"))["attempt_id"], 1);
}

}  // namespace
}  // namespace carpus::server
