// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who operates, who only looks on, and whose the exercise is, through real sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "protocol/bodies.hpp"
#include "server/station_test_support.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;
using namespace testing;

TEST_F(StationTest, SecondPageIsBusyWhileTheFirstOperatesAndHttpStillWorks) {
  auto first = operate(port());
  PageClient second(port());
  second.send(kSecondHello);
  EXPECT_THAT(second.wait_for_type("busy"), HasSubstr("Another page operates"));
  second.send(R"({"type":"act","id":"finish"})");
  EXPECT_THAT(second.wait_for_type("error"), HasSubstr("does not operate"));
  EXPECT_EQ(request(port(), "/").result_int(), 200U);
  first->send(R"({"type":"act","id":"finish"})");
  (void)first->wait_for_type("score");
  first->vanish();
  EXPECT_THAT(say_hello(second, kSecondHello, "welcome"), HasSubstr("\"exercise\":0,"));
}

TEST_F(StationTest, SeatOfALostPageIsKeptForIt) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->vanish();
  PageClient second(port());
  EXPECT_THAT(say_hello(second, kSecondHello, "busy"), HasSubstr("busy"));
  PageClient again(port());
  EXPECT_THAT(say_hello(again, kHello, "welcome"), Not(HasSubstr("\"exercise\":0,")));
  EXPECT_THAT(say_hello(second, kSecondHello, "busy"), HasSubstr("Another page operates"));
  EXPECT_EQ(records_->list().size(), 0U);
}

TEST_F(StationTest, LostPageGoesOnWhereItWasWithItsLogAndPictures) {
  auto page = operate(port());
  page->send(R"({"type":"take_shot","rotation_deg":30,"tilt_deg":-5,"reference":"held_forearm"})");
  const auto is_picture = [](const auto& frame) { return frame.is_binary; };
  const auto picture = page->wait_for(is_picture);
  ASSERT_TRUE(picture.has_value());
  page->vanish();
  PageClient again(port());
  const Json welcome = Json::parse(say_hello(again, kHello, "welcome"));
  EXPECT_GT(welcome["exercise"], 0);
  EXPECT_EQ(welcome["trainee"], "Ada");
  EXPECT_THAT(welcome["started_at"].get<std::string>(), ::testing::MatchesRegex("20.*T.*Z"));
  const Json event = Json::parse(again.wait_for_type("event"));
  EXPECT_EQ(event["kind"], "shot_taken");
  const auto shown = again.wait_for(is_picture);
  ASSERT_TRUE(shown.has_value());
  EXPECT_EQ(shown->content, picture->content);
  // Time stands still until the page goes on.
  (void)wait_for_snapshot(again, [](const Json& s) { return bool(s["paused"]); });
  expect_time_stands(again);
  again.send(kGoOn);
  const Json after = wait_for_snapshot(again, [](const Json& s) { return !s["paused"]; });
  (void)wait_for_snapshot(again, [&](const Json& s) { return s["tick"] > after["tick"]; });
  again.send(R"({"type":"act","id":"finish"})");
  EXPECT_EQ(Json::parse(again.wait_for_type("score"))["attempt_id"], 1);
}

TEST_F(StationTest, DriverOfALostPageIsOffWhenItComesBack) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->send(R"({"type":"hand","sequence":2,"hand":0,"tip_mm":[40,40,40],"shaft":[0,0.6,0.8],)"
             R"("thrust_n":5,"driver":"forward","guidance":"direct"})");
  std::this_thread::sleep_for(20ms);
  page->vanish();
  PageClient again(port());
  (void)say_hello(again, kHello, "welcome");
  again.send(kGoOn);
  (void)wait_for_snapshot(again, [](const Json& s) { return s["tick"] > 300; });
  again.send(R"({"type":"act","id":"finish"})");
  (void)again.wait_for_type("score");
  const auto attempt = records_->find(1);
  ASSERT_TRUE(attempt.has_value());
  const auto decoded = simulation::decode(attempt->recording);
  ASSERT_TRUE(decoded.has_value());
  ASSERT_FALSE(decoded->runs.empty());
  const auto& last = decoded->runs.back().input;
  EXPECT_EQ(last.hands[0].driver, simulation::Driver::Off);
  EXPECT_EQ(last.hands[0].thrust_n, 0.0);
}

TEST_F(StationTest, PageThatComesBackBeforeItsOldConnectionIsKnownDeadGetsItsSeat) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  PageClient twin(port());
  // The old connection answers no ping from now on.
  EXPECT_THAT(say_hello(twin, kHello, "welcome"), Not(HasSubstr("\"exercise\":0,")));
  EXPECT_TRUE(page->wait_until_closed());
  twin.send(kGoOn);
  (void)wait_for_snapshot(twin, [](const Json& s) { return !s["paused"] && s["tick"] > 20; });
}

constexpr const char* kPedalDown = R"({"type":"pedal","down":true})";
constexpr const char* kDrill =
    R"({"type":"hand","sequence":2,"hand":0,"tip_mm":[40,40,40],"shaft":[0,0.6,0.8],)"
    R"("thrust_n":5,"driver":"forward","guidance":"direct"})";

/// The inputs of the attempt that is stored when it is finished now.
simulation::InputRuns inputs_at_the_end(PageClient& page, records::AttemptKeeper& records) {
  page.send(R"({"type":"act","id":"finish"})");
  (void)page.wait_for_type("score");
  const auto attempt = records.find(1);
  const auto decoded = simulation::decode(attempt ? attempt->recording : std::vector<std::byte>{});
  EXPECT_TRUE(decoded.has_value());
  return decoded ? decoded->runs : simulation::InputRuns{};
}

TEST_F(StationTest, PedalOfAPageThatDisappearsIsUpWhenItComesBack) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->send(kPedalDown);
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["c_arm"]["live"] == true; });
  page->vanish();
  PageClient again(port());
  (void)say_hello(again, kHello, "welcome");
  again.send(kGoOn);
  const Json before = wait_for_snapshot(again, [](const Json& s) { return !s["paused"]; });
  const Json after = wait_for_snapshot(
      again, [&](const Json& s) { return s["tick"] > before["tick"].get<int>() + 100; });
  EXPECT_EQ(after["c_arm"]["live"], false);
}

TEST_F(StationTest, WhatAPageHeldWhoseSeatIsTakenOverIsLetGo) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->send(kDrill);
  page->send(kPedalDown);
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["c_arm"]["live"] == true; });
  // It falls silent with its connection open; it comes again by another.
  PageClient twin(port());
  (void)say_hello(twin, kHello, "welcome");
  twin.send(kGoOn);
  const Json before = wait_for_snapshot(twin, [](const Json& s) { return !s["paused"]; });
  (void)wait_for_snapshot(
      twin, [&](const Json& s) { return s["tick"] > before["tick"].get<int>() + 20; });
  const auto runs = inputs_at_the_end(twin, *records_);
  ASSERT_FALSE(runs.empty());
  Tick end = 0;
  for (const simulation::InputRun& run : runs) {
    end += run.ticks;
    if (end <= before["tick"].get<Tick>() + 5) continue;
    EXPECT_FALSE(run.input.c_arm.pedal_is_down) << "tick " << end;
    EXPECT_EQ(run.input.hands[0].driver, simulation::Driver::Off) << "tick " << end;
  }
}

TEST_F(StationTest, PagesThatFightOverAHandLeaveItToWhoHasTheSeat) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  const auto hand_at = [](int x) {
    return R"({"type":"hand","sequence":9,"hand":1,"tip_mm":[)" + std::to_string(x) +
           R"(,50,60],"shaft":[0,0,1],"thrust_n":0,"driver":"off","guidance":"direct"})";
  };
  // A stranger, and a second window that says the same word.
  PageClient stranger(port());
  stranger.send(kSecondHello);
  EXPECT_THAT(stranger.wait_for_type("busy"), HasSubstr("Another page"));
  PageClient twin(port());
  for (int i = 0; i < 100; ++i) {
    page->send(hand_at(11));
    stranger.send(hand_at(22));
    twin.send(kHello);
    twin.send(hand_at(33));
    // Its pings must be answered, or it would lose its seat by silence.
    (void)page->wait_for([](const auto&) { return false; }, 5ms);
  }
  EXPECT_THAT(stranger.wait_for_type("error"), HasSubstr("does not operate"));
  EXPECT_THAT(twin.wait_for_type("busy"), HasSubstr("Another page"));
  EXPECT_TRUE(page->is_connected());
  for (const simulation::InputRun& run : inputs_at_the_end(*page, *records_)) {
    const double x = run.input.hands[1].tip_in_patient.x;
    EXPECT_TRUE(std::abs(x - 22) > 1e-3 && std::abs(x - 33) > 1e-3) << x;
  }
}

class ImpatientStationTest : public StationTest {
 protected:
  [[nodiscard]] StationPatience patience() const override { return {50ms, 600s}; }
};

TEST_F(ImpatientStationTest, SeatLapsesButItsOwnerGetsItBackUntilAnotherStartsAnew) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->vanish();
  PageClient second(port());
  const Json offered = Json::parse(say_hello(second, kSecondHello, "welcome"));
  EXPECT_GT(offered["exercise"], 0);
  EXPECT_EQ(offered["is_own"], false);
  PageClient again(port());
  const Json back = Json::parse(say_hello(again, kHello, "welcome"));
  EXPECT_EQ(back["exercise"], offered["exercise"]);
  EXPECT_EQ(back["is_own"], true);
  EXPECT_TRUE(second.wait_until_closed());
  again.vanish();
  PageClient third(port());
  (void)say_hello(third, kSecondHello, "welcome");
  third.send(kStart);
  const Json begun = Json::parse(third.wait_for_type("welcome"));
  EXPECT_NE(begun["exercise"], offered["exercise"]);
  EXPECT_EQ(begun["is_own"], true);
  wait_for_attempts(1);
  EXPECT_EQ(records_->find(1)->summary.outcome, records::Outcome::Unfinished);
}

TEST_F(ImpatientStationTest, NobodyGoesOnUnderAnothersName) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->vanish();
  PageClient second(port());
  (void)say_hello(second, kSecondHello, "welcome");
  const Json before = wait_for_snapshot(second, [](const Json& s) { return bool(s["paused"]); });
  for (
      const char* text :
      {kHand, kGoOn, R"({"type":"act","id":"finish"})",
       R"({"type":"wrist","flexion_deg":1,"radial_deviation_deg":0,"pronation_deg":0,"traction_n":0})",
       R"({"type":"take_shot","rotation_deg":0,"tilt_deg":0,"reference":"held_forearm"})"}) {
    second.send(text);
    EXPECT_THAT(second.wait_for_type("error"), HasSubstr("another page's")) << text;
  }
  PageClient again(port());
  (void)say_hello(again, kHello, "welcome");
  const Json after = wait_for_snapshot(again, [](const Json&) { return true; });
  EXPECT_EQ(after["tick"], before["tick"]);
  EXPECT_EQ(after["state_hash"], before["state_hash"]);
  EXPECT_EQ(records_->list().size(), 0U);
}

TEST_F(ImpatientStationTest, PageThatOnlySaidHelloGivesTheSeatToTheNextThatAsks) {
  PageClient idle(port());
  EXPECT_THAT(say_hello(idle, kHello, "welcome"), HasSubstr("\"exercise\":0,"));
  PageClient second(port());
  EXPECT_THAT(say_hello(second, kSecondHello, "welcome"), HasSubstr("\"exercise\":0,"));
  EXPECT_TRUE(idle.wait_until_closed());
  second.send(kStart);
  EXPECT_THAT(second.wait_for_type("welcome"), HasSubstr("\"is_own\":true"));
  PageClient third(port());
  third.send(kHello);
  EXPECT_THAT(third.wait_for_type("busy"), HasSubstr("Another page operates"));
}

class IdleStationTest : public StationTest {
 protected:
  [[nodiscard]] StationPatience patience() const override { return {600s, 300ms}; }
};

TEST_F(IdleStationTest, PageThatDoesNothingInItsExerciseGivesTheSeatToTheNextThatAsks) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 500; });
  PageClient second(port());
  EXPECT_THAT(say_hello(second, kSecondHello, "welcome"), HasSubstr("\"is_own\":false"));
  EXPECT_TRUE(page->wait_until_closed());
  wait_for_attempts(1);
  EXPECT_THAT(second.wait_for_type("welcome"), HasSubstr("\"exercise\":0,"));
}

class LinkedStationTest : public StationTest {
 protected:
  [[nodiscard]] StationPatience patience() const override { return {50ms, 600s}; }
  [[nodiscard]] NetworkOptions network() const override {
    NetworkOptions options;
    options.links = links_;
    return options;
  }
  [[nodiscard]] std::string cookie_for(const std::string& token) const {
    const std::string set(request(port(), "/?token=" + token)["Set-Cookie"]);
    return set.substr(0, set.find(';'));
  }
  const AccessLinks links_ = make_access_links();
};

TEST_F(LinkedStationTest, InstructorEndsAnothersExerciseAndItsPageIsTold) {
  const auto page = operate(port(), cookie_for(links_.trainee));
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  PageClient instructor(port(), cookie_for(links_.instructor));
  instructor.send(kSecondHello);
  EXPECT_THAT(instructor.wait_for_type("busy"), HasSubstr("\"may_end\":true"));
  instructor.send(R"({"type":"end"})");
  EXPECT_THAT(page->wait_for_type("error"), HasSubstr("An instructor has ended"));
  EXPECT_TRUE(page->wait_until_closed());
  EXPECT_THAT(say_hello(instructor, kSecondHello, "welcome"), HasSubstr("\"exercise\":0,"));
  wait_for_attempts(1);
  EXPECT_EQ(records_->find(1)->summary.outcome, records::Outcome::Unfinished);
}

TEST_F(LinkedStationTest, TraineeNeitherEndsNorSeesAnothersExercise) {
  auto page = operate(port(), cookie_for(links_.trainee));
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  PageClient other(port(), cookie_for(links_.trainee));
  other.send(kSecondHello);
  EXPECT_THAT(other.wait_for_type("busy"), HasSubstr("\"may_end\":false"));
  other.send(R"({"type":"end"})");
  EXPECT_THAT(other.wait_for_type("error"), HasSubstr("Only an instructor"));
  page->vanish();
  const Json welcome = Json::parse(say_hello(other, kSecondHello, "welcome"));
  EXPECT_GT(welcome["exercise"], 0);
  EXPECT_EQ(welcome["trainee"], "");
  EXPECT_THAT(other.wait_for_type("snapshot", 300ms), HasSubstr("no snapshot"));
  PageClient instructor(port(), cookie_for(links_.instructor));
  const Json told = Json::parse(say_hello(instructor, kSecondHello, "welcome"));
  EXPECT_EQ(told["trainee"], "Ada");
  EXPECT_EQ(told["is_own"], false);
  (void)wait_for_snapshot(instructor, [](const Json& s) { return bool(s["paused"]); });
}

TEST_F(LinkedStationTest, TraineeSeesWhatWasDoneInTheirBrowserAlone) {
  const std::string own = cookie_for(links_.trainee);
  const auto page = operate(port(), own);
  page->send(R"({"type":"act","id":"finish"})");
  (void)page->wait_for_type("score");
  const std::string other = cookie_for(links_.trainee);
  const std::string instructor = cookie_for(links_.instructor);
  EXPECT_EQ(request(port(), "/api/attempts/1", {{"Cookie", own}}).result_int(), 200U);
  EXPECT_EQ(request(port(), "/api/attempts/1", {{"Cookie", other}}).result_int(), 404U);
  EXPECT_EQ(request(port(), "/api/attempts/1", {{"Cookie", instructor}}).result_int(), 200U);
}

TEST_F(StationTest, PageThatVanishesWhileItsExerciseIsSetUpFindsIt) {
  {
    PageClient page(port());
    (void)say_hello(page, kHello, "welcome");
    page.send(kStart);
    page.vanish();
  }
  PageClient again(port());
  Json welcome;
  for (int i = 0; i < 200 && (welcome.is_null() || welcome["exercise"] == 0); ++i) {
    welcome = Json::parse(say_hello(again, kHello, "welcome"));
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_GT(welcome["exercise"], 0);
  EXPECT_EQ(welcome["is_own"], true);
  EXPECT_EQ(welcome["trainee"], "Ada");
}

}  // namespace
}  // namespace carpus::server
