// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole station on loopback: a real client operates on a synthetic wrist.
#include "server/station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "protocol/bodies.hpp"
#include "server/loopback_client_test_support.hpp"
#include "server/station_http.hpp"
#include "simulation/operation_test_support.hpp"
#include "simulation/recording.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;
using testing::PageClient;
using testing::request;
using Json = nlohmann::json;

constexpr const char* kHello = R"({"type":"hello","protocol":12,"page":"first"})";
constexpr const char* kSecondHello = R"({"type":"hello","protocol":12,"page":"second"})";
constexpr const char* kStart = R"({"type":"start","trainee":"Ada","procedure":"test_exercise",)"
                               R"("input_device":"mouse","seed":7})";
constexpr const char* kHand =
    R"({"type":"hand","sequence":1,"hand":0,"tip_mm":[40,40,40],"shaft":[0,0.6,0.8],)"
    R"("thrust_n":2,"driver":"off","guidance":"direct"})";

using simulation::test::exercise;
using simulation::test::wrist;

const procedure::ProcedureList& procedures() {
  static const procedure::ProcedureList list({&exercise()});
  return list;
}

class StationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "carpus-station-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    std::ofstream(folder_ / "index.html") << "<title>Carpus</title>";
    records_ = std::make_unique<records::AttemptKeeper>(folder_ / "attempts.sqlite");
    station_ = std::make_unique<Station>(
        wrist(), procedures(), *records_, [](const std::string&) {}, patience(),
        OverCases{[this](const std::string& id) {
                    if (id != "other") return false;
                    chosen_ = id;
                    network_->stop();
                    return true;
                  },
                  owners_});
    http_ = std::make_unique<StationHttp>(wrist(), procedures(), "glTF", *records_,
                                          station_->owners(), folder_);
    NetworkOptions options = network();
    options.port = 0;
    options.ping_interval = 100ms;
    network_ = std::make_unique<NetworkServer>(
        options, [this](const HttpRequest& r) { return http_->answer(r); }, *station_);
    station_->attach(*network_);
    thread_ = std::thread([this] { network_->run(); });
  }
  void TearDown() override {
    stop();
    station_.reset();
    network_.reset();
    fs::remove_all(folder_);
  }
  void stop() {
    network_->stop();
    if (thread_.joinable()) thread_.join();
  }
  [[nodiscard]] virtual StationPatience patience() const { return {600s, 600s}; }
  [[nodiscard]] virtual NetworkOptions network() const { return {}; }
  [[nodiscard]] std::uint16_t port() const { return network_->port(); }

  [[nodiscard]] static std::unique_ptr<PageClient> operate(std::uint16_t port,
                                                           const std::string& cookie = "") {
    auto page = std::make_unique<PageClient>(port, cookie);
    page->send(kHello);
    EXPECT_THAT(page->wait_for_type("welcome"), HasSubstr("\"exercise\":0,"));
    page->send(kStart);
    page->send(kHand);
    return page;
  }
  /// Says hello until it is answered by a message of this type, and returns that.
  static std::string say_hello(PageClient& page, const char* hello, const std::string& type) {
    std::string answer;
    for (int i = 0; i < 200 && answer.find("\"type\":\"" + type) == std::string::npos; ++i) {
      if (i > 0) std::this_thread::sleep_for(20ms);
      page.send(hello);
      const auto frame = page.wait_for([](const auto& f) {
        return !f.is_binary && (f.content.find("\"type\":\"busy") != std::string::npos ||
                                f.content.find("\"type\":\"welcome") != std::string::npos);
      });
      answer = frame ? frame->content : "";
    }
    return answer;
  }
  static constexpr const char* kGoOn = R"({"type":"pause","on":false})";

  /// Waits until the records hold so many attempts.
  void wait_for_attempts(std::size_t count) {
    for (int i = 0; i < 1000 && records_->list().size() < count; ++i) {
      std::this_thread::sleep_for(10ms);
    }
    ASSERT_EQ(records_->list().size(), count);
  }
  static Json wait_for_snapshot(PageClient& page, const std::function<bool(const Json&)>& fits) {
    Json found;
    (void)page.wait_for([&](const PageClient::Frame& frame) {
      if (frame.is_binary) return false;
      const Json json = Json::parse(frame.content);
      if (json["type"] != "snapshot" || !fits(json)) return false;
      found = json;
      return true;
    });
    EXPECT_FALSE(found.is_null()) << "no such snapshot";
    return found;
  }
  /// That a station which has said "paused" says the same tick for as long as it says so: counted
  /// in what it sends, so that a slow machine has as long as it needs.
  static void expect_time_stands(PageClient& page) {
    constexpr int kSnapshots = 12;
    const auto next = [&] { return wait_for_snapshot(page, [](const Json&) { return true; }); };
    const Json first = next();
    for (int i = 0; i < kSnapshots; ++i) {
      const Json later = next();
      EXPECT_TRUE(later["paused"].get<bool>());
      EXPECT_EQ(later["tick"], first["tick"]);
    }
  }

  fs::path folder_;
  std::unique_ptr<records::AttemptKeeper> records_;
  std::unique_ptr<Station> station_;
  std::unique_ptr<StationHttp> http_;
  std::unique_ptr<NetworkServer> network_;
  std::thread thread_;
  std::string chosen_;  ///< the case that a page chose
  std::shared_ptr<AttemptOwners> owners_ = std::make_shared<AttemptOwners>();
};

TEST_F(StationTest, ChoosingAnotherCaseStoresWhatRunsAndEndsTheStation) {
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 50; });
  page->send(R"({"type":"choose_case","case":"none"})");
  EXPECT_THAT(page->wait_for_type("error"), HasSubstr("There is no case 'none'"));
  PageClient guest(port());
  guest.send(R"({"type":"choose_case","case":"other"})");
  EXPECT_THAT(guest.wait_for_type("error"), HasSubstr("does not operate"));
  page->send(R"({"type":"choose_case","case":"other"})");
  thread_.join();
  station_->detach();
  EXPECT_EQ(chosen_, "other");
  ASSERT_EQ(records_->list().size(), 1U);
  EXPECT_EQ(records_->list().front().outcome, records::Outcome::Unfinished);
  EXPECT_EQ(&station_->owners(), owners_.get()) << "whose they are is known to the next one";
}

TEST_F(StationTest, WholeExerciseEndsWithAScoreThatIsInTheRecords) {
  const auto page = operate(port());
  const Json moving = wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 50; });
  EXPECT_EQ(moving["step"], 0);
  page->send(R"({"type":"take_shot","rotation_deg":30,"tilt_deg":-5,"reference":"held_forearm"})");
  const auto picture = page->wait_for([](const auto& f) { return f.is_binary; });
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->content.substr(0, 4), "CARM");
  EXPECT_EQ(picture->content.size(), 40U + 512U * 512U);
  float rotation = 0;
  std::memcpy(&rotation, picture->content.data() + 24, 4);
  EXPECT_EQ(rotation, 30.0F);
  page->send(R"({"type":"act","id":"finish"})");
  const Json last = wait_for_snapshot(*page, [](const Json& s) { return bool(s["finished"]); });
  const Json score = Json::parse(page->wait_for_type("score"));
  EXPECT_EQ(score["attempt_id"], 1);
  EXPECT_TRUE(score["report"].contains("items"));

  const auto list = Json::parse(request(port(), "/api/attempts").body())["attempts"];
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["trainee"], "Ada");
  EXPECT_EQ(list[0]["outcome"], "finished");
  EXPECT_EQ(list[0]["overall"], score["overall"]);
  EXPECT_EQ(list[0]["state_hash"], last["state_hash"]);
  const auto detail = Json::parse(request(port(), "/api/attempts/1").body());
  EXPECT_EQ(detail["score"], score["report"]);
  EXPECT_EQ(detail["events"].back()["kind"], "finished");
}

TEST_F(StationTest, LivePicturesComeWhileThePedalIsHeldAndTheLastOneIsHeld) {
  const auto page = operate(port());
  const auto number = [](const PageClient::Frame& frame, std::size_t at, std::size_t bytes) {
    std::uint32_t value = 0;
    std::memcpy(&value, frame.content.data() + at, bytes);
    return value;
  };
  const auto next = [&](std::uint32_t kind) {
    return page->wait_for([&](const auto& f) { return f.is_binary && number(f, 8, 4) == kind; },
                          30ms);
  };
  std::optional<PageClient::Frame> coarse;
  std::optional<PageClient::Frame> full;
  for (int i = 0; i < 300 && !full; ++i) {
    page->send(R"({"type":"pedal","down":true})");
    const auto frame = next(1);
    if (frame && number(*frame, 16, 2) == 256) coarse = frame;
    if (frame && number(*frame, 16, 2) == 512) full = frame;
  }
  EXPECT_TRUE(coarse.has_value()) << "at first it is not known whether anything moves";
  ASSERT_TRUE(full.has_value()) << "then all rests";
  EXPECT_EQ(full->content.size(), 40U + 512U * 512U);
  // Nothing more is heard of the pedal: the host lets go.
  const auto held =
      page->wait_for([&](const auto& f) { return f.is_binary && number(f, 8, 4) == 2; });
  ASSERT_TRUE(held.has_value());
  EXPECT_GE(number(*held, 12, 4), 1U) << "it is numbered as shots are";
  const Json after =
      wait_for_snapshot(*page, [](const Json& s) { return s["c_arm"]["live"] == false; });
  EXPECT_GE(after["shots"], 1);
  EXPECT_GT(after["dose_cgy_cm2"], 0.0);
}

TEST_F(StationTest, RecordingOfALiveExerciseReplaysToTheSameHash) {
  const auto page = operate(port());
  for (int i = 0; i < 200; ++i) {
    const double z = 40.0 - 0.2 * i;
    page->send(R"({"type":"hand","sequence":2,"hand":0,"tip_mm":[2,-1,)" + std::to_string(z) +
               R"(],"shaft":[0.1,0.2,1],"thrust_n":5,"driver":"forward","guidance":"direct"})");
    std::this_thread::sleep_for(1ms);
  }
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 100; });
  page->send(R"({"type":"act","id":"finish"})");
  (void)page->wait_for_type("score");
  const auto recording = request(port(), "/api/attempts/1/recording");
  EXPECT_EQ(recording["Content-Type"], "application/octet-stream");
  const std::string& bytes = recording.body();
  const auto decoded = simulation::decode(std::as_bytes(std::span(bytes.data(), bytes.size())));
  ASSERT_TRUE(decoded.has_value()) << decoded.error();
  const simulation::Replay replay = simulation::replay(wrist(), exercise(), *decoded);
  EXPECT_TRUE(replay.hash_matches);
  EXPECT_TRUE(replay.case_matches);
  EXPECT_TRUE(replay.last.finished);
  EXPECT_GT(replay.last.tick, 100U);
}

TEST_F(StationTest, BadMessagesAreAnsweredAndTheExerciseGoesOn) {
  const auto page = operate(port());
  const auto refused = [&](const std::string& text, const char* reason, bool binary = false) {
    page->send(text, binary);
    EXPECT_THAT(page->wait_for_type("error"), HasSubstr(reason)) << text.substr(0, 100);
  };
  refused("rubbish", "not valid JSON");
  refused(R"({"type":"act","id":"pick_up","item":999})", "from 0 to 254");
  refused(R"({"type":"hand"})", "is missing");
  refused(R"({"type":"welcome"})", "unknown message type");
  refused(R"({"type":"pause","x":")" + std::string(20000, 'x') + "\"}", "longer than 16384 bytes");
  refused("\x01\x02", "binary", true);
  const Json now = wait_for_snapshot(*page, [](const Json&) { return true; });
  (void)wait_for_snapshot(*page, [&](const Json& s) { return s["tick"] > now["tick"]; });
}

TEST_F(StationTest, PageIsToldWhatIsDoneAndWhatItMayAskFor) {
  const auto page = operate(port());
  const Json exercise = Json::parse(page->wait_for_type("exercise"));
  EXPECT_EQ(exercise["procedure"]["id"], "test_exercise");
  EXPECT_EQ(exercise["bodies"].size(), wrist().bones.size());
  const Json actions = Json::parse(page->wait_for_type("actions"));
  EXPECT_GT(actions["actions"].size(), 10U);
  page->send(R"({"type":"act","id":"take","hand":1,"instrument":"probe"})");
  const Json two = wait_for_snapshot(*page, [](const Json& s) { return s["items"].size() == 2U; });
  EXPECT_EQ(two["items"][1]["instrument"], "probe");
  EXPECT_EQ(two["items"][1]["hand"], 1);
  page->send(R"({"type":"act","id":"take","instrument":"spoon"})");
  EXPECT_THAT(page->wait_for_type("error"), HasSubstr("no instrument 'spoon'"));
}

TEST_F(StationTest, ProcedureThatIsNotOfferedIsRefusedAndWhatRunsGoesOn) {
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  std::string other = kStart;
  other.replace(other.find("test_exercise"), 13, "no_such_thing");
  page->send(other);
  EXPECT_THAT(page->wait_for_type("error"), HasSubstr("no_such_thing"));
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 40; });
  EXPECT_EQ(records_->list().size(), 0U);
}

TEST_F(StationTest, FloodOfMessagesIsThinnedWithoutHarm) {
  const auto page = operate(port());
  for (int i = 0; i < 6000; ++i) page->send(kHand);
  EXPECT_THAT(page->wait_for_type("error"), HasSubstr("Too many messages"));
  // Until what was sent has passed, this too is one too many.
  const auto is_score = [](const auto& frame) {
    return frame.content.find("\"type\":\"score\"") != std::string::npos;
  };
  bool is_scored = false;
  for (int i = 0; i < 50 && !is_scored; ++i) {
    page->send(R"({"type":"act","id":"finish"})");
    is_scored = page->wait_for(is_score, 400ms).has_value();
  }
  EXPECT_TRUE(is_scored);
}

TEST_F(StationTest, QuizAsksShowsAndTellsTheTruthOnlyAfterTheAnswer) {
  PageClient page(port());
  page.send(kHello);
  (void)page.wait_for_type("welcome");
  page.send(R"({"type":"quiz_next"})");
  EXPECT_THAT(page.wait_for_type("error", 20s), HasSubstr("Another page's quiz"));
  page.send(R"({"type":"quiz_begin","seed":7})");
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

TEST_F(StationTest, QuizLeavesTheExerciseAlone) {
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->send(R"({"type":"quiz_begin","seed":7})");
  EXPECT_THAT(page->wait_for_type("quiz_question", 20s), HasSubstr("\"number\":1,"));
  page->send(R"({"type":"act","id":"finish"})");
  EXPECT_EQ(Json::parse(page->wait_for_type("score"))["attempt_id"], 1);
}

TEST_F(StationTest, CommandsWithoutAnExerciseAndTalkWithoutHelloAreRefused) {
  PageClient page(port());
  page.send(kStart);
  EXPECT_THAT(page.wait_for_type("error"), HasSubstr("Say hello first"));
  page.send(R"({"type":"hello","protocol":1,"page":""})");
  EXPECT_THAT(page.wait_for_type("error"), HasSubstr("Reload the page"));
  EXPECT_TRUE(page.wait_until_closed());
  PageClient other(port());
  other.send(kHello);
  other.send(R"({"type":"act","id":"read_gauge"})");
  EXPECT_THAT(other.wait_for_type("error"), HasSubstr("No exercise runs"));
}

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

TEST_F(StationTest, NameThatReadsAsSomethingElseIsRefusedWithASentence) {
  PageClient page(port());
  (void)say_hello(page, kHello, "welcome");
  for (const auto& [name, why] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"(Ada\nBo)", "control character (U+000A)"}, {R"(\u202eadA)", "(U+202E)"}}) {
    std::string start = kStart;
    start.replace(start.find("Ada"), 3, name);
    page.send(start);
    EXPECT_THAT(page.wait_for_type("error"), HasSubstr(why));
  }
  std::string start = kStart;
  start.replace(start.find("Ada"), 3, "José 张");
  page.send(start);
  EXPECT_THAT(page.wait_for_type("welcome"), HasSubstr("José 张"));
}

class ForgetfulStationTest : public StationTest {
 protected:
  [[nodiscard]] StationPatience patience() const override { return {50ms, 100ms}; }
};

TEST_F(ForgetfulStationTest, PageThatDoesNotComeBackLeavesAnUnfinishedAttemptThatReplays) {
  auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->vanish();
  wait_for_attempts(1);
  const auto attempt = records_->find(1);
  EXPECT_EQ(attempt->summary.outcome, records::Outcome::Unfinished);
  EXPECT_FALSE(attempt->summary.overall.has_value());
  const auto decoded = simulation::decode(attempt->recording);
  ASSERT_TRUE(decoded.has_value());
  EXPECT_TRUE(simulation::replay(wrist(), exercise(), *decoded).hash_matches);
  PageClient second(port());
  EXPECT_THAT(say_hello(second, kSecondHello, "welcome"), HasSubstr("\"exercise\":0,"));
}

TEST_F(StationTest, StartingAnewAndStoppingTheStationStoreWhatRan) {
  constexpr int kFarOn = 1500;  // a slow machine shows a new exercise late
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > kFarOn; });
  page->send(kStart);
  wait_for_attempts(1);
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] < kFarOn; });
  stop();
  station_.reset();
  EXPECT_EQ(records_->list().size(), 2U);
}

TEST_F(StationTest, PauseStopsTimeAndResumes) {
  const auto is_paused = [](const Json& s) { return bool(s["paused"]); };
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  page->send(R"({"type":"pause","on":true})");
  (void)wait_for_snapshot(*page, is_paused);
  expect_time_stands(*page);
  page->send(R"({"type":"pause","on":false})");
  const Json again = wait_for_snapshot(*page, [](const Json& s) { return !s["paused"]; });
  (void)wait_for_snapshot(*page, [&](const Json& s) { return s["tick"] > again["tick"]; });
}

TEST_F(StationTest, SilentPageStopsTimeUntilItIsHeardAgain) {
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  std::this_thread::sleep_for(1600ms);  // this client answers pings only while it waits
  const Json paused = wait_for_snapshot(*page, [](const Json& s) { return bool(s["paused"]); });
  EXPECT_LT(paused["tick"], 1500);
  (void)wait_for_snapshot(*page, [](const Json& s) { return !s["paused"]; });
}

TEST_F(StationTest, FullDiskWhileSavingIsToldAndNothingIsLost) {
  records_->store().limit_pages(1);  // as large as it is now
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  for (int i = 0; i < 2500; ++i) {  // fills the recording beyond 8 pages
    const std::string far = std::to_string(i % 2 == 0 ? 40 + 0.01 * i : -40.0);
    page->send(R"({"type":"hand","sequence":2,"hand":)" + std::to_string(i / 2 % 2) +
               R"(,"tip_mm":[)" + far + "," + far + "," + far + R"(],"shaft":[)" +
               (i % 2 == 0 ? "1" : "-1") +
               R"(,1,0.5],"thrust_n":5,"driver":"off","guidance":"direct"})");
    std::this_thread::sleep_for(1ms);
  }
  page->send(R"({"type":"act","id":"finish"})");
  EXPECT_THAT(page->wait_for_type("error"), HasSubstr("free some space"));
  const Json score = Json::parse(page->wait_for_type("score"));
  EXPECT_EQ(score["attempt_id"], 0);
  EXPECT_EQ(records_->waiting(), 1U);
  records_->store().limit_pages(100000);
  page->send(kStart);
  page->send(R"({"type":"act","id":"finish"})");
  (void)page->wait_for_type("score");
  EXPECT_EQ(records_->list().size(), 2U);
}

TEST_F(StationTest, TimeGoesOnWhileOthersAttackTheDoor) {
  const auto page = operate(port());
  (void)wait_for_snapshot(*page, [](const Json& s) { return s["tick"] > 20; });
  std::atomic<bool> goes_on{true};
  std::vector<std::thread> attackers;
  for (int i = 0; i < 3; ++i) {
    attackers.emplace_back([&, i] {
      while (goes_on) {
        testing::RawClient client(port());
        if (i == 0) client.send(std::string(20'000, 'x'));
        if (i == 1) {
          client.send("GET / HTTP/1.1\r\nHost: " + testing::host_of(port()) +
                      "\r\nTransfer-Encoding: chunked\r\n\r\n1;" + std::string(60'000, 'x'));
        }
        if (i == 2) (void)request(port(), "/api/instruments");
        std::this_thread::sleep_for(1ms);
      }
    });
  }
  const Json before = wait_for_snapshot(*page, [](const Json&) { return true; });
  const Json after = wait_for_snapshot(
      *page, [&](const Json& s) { return s["tick"] > before["tick"].get<int>() + 1000; });
  goes_on = false;
  for (std::thread& attacker : attackers) attacker.join();
  EXPECT_FALSE(after.is_null());  // how many ticks a second it keeps: tests/system/soak
}

TEST_F(StationTest, WhatIsSaidWhileAnExerciseIsSetUpIsDoneInItsOrder) {
  PageClient page(port());
  (void)say_hello(page, kHello, "welcome");
  page.send(kStart);
  page.send(R"({"type":"act","id":"take","instrument":"probe"})");
  page.send(kStart);
  page.send(kHand);
  page.send(R"({"type":"act","id":"finish"})");
  const Json score = Json::parse(page.wait_for_type("score"));
  EXPECT_EQ(score["attempt_id"], 2);
  EXPECT_EQ(records_->find(1)->summary.outcome, records::Outcome::Unfinished);
  EXPECT_EQ(records_->find(2)->summary.outcome, records::Outcome::Finished);
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

TEST_F(StationTest, HttpTellsTheCaseWithoutTheAnswer) {
  const auto answer = request(port(), "/api/case");
  ASSERT_TRUE(protocol::parse_case_description(answer.body()).has_value());
  EXPECT_EQ(answer.body().find("axis"), std::string::npos);
  EXPECT_TRUE(Json::parse(answer.body())["simulated"]);
  const Json offered = Json::parse(request(port(), "/api/procedures").body());
  EXPECT_EQ(offered["procedures"][0]["id"], "test_exercise");
  const auto instruments = request(port(), "/api/instruments").body();
  ASSERT_TRUE(protocol::parse_instrument_list(instruments).has_value());
  EXPECT_GT(Json::parse(instruments)["instruments"].size(), 5U);
  EXPECT_EQ(request(port(), "/api/scene.glb")["Content-Type"], "model/gltf-binary");
  EXPECT_EQ(request(port(), "/").body(), "<title>Carpus</title>");
}

TEST_F(StationTest, HttpAnswersNothingThatIsNotThere) {
  for (const char* target :
       {"/api", "/api/attempts/1", "/api/attempts/0", "/api/attempts/-1", "/api/attempts/x",
        "/api/attempts/1/x", "/api/attempts/99999999999999999999", "/api/attemptsx",
        "/attempts.sqlite.bak"}) {
    EXPECT_EQ(request(port(), target).result_int(), 404U) << target;
  }
  for (const char* target : {"/../secret", "/%2e%2e/secret", "/..%2fsecret", "/a\\b", "/api/"}) {
    EXPECT_EQ(request(port(), target).result_int(), 400U) << target;
  }
}

}  // namespace
}  // namespace carpus::server
