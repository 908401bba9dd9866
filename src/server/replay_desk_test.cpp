// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/replay_desk.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "core/hexadecimal.hpp"
#include "protocol/bodies.hpp"
#include "server/exercise.hpp"
#include "session/session.hpp"
#include "simulation/keyframe_due.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::server {
namespace {

using Json = nlohmann::json;

using simulation::test::exercise;
using simulation::test::Operator;
using simulation::test::wrist;

struct Operated {
  simulation::Recording recording;
  std::vector<simulation::Event> events;
};

/// Longer than the synthetic scaphoid.
constexpr std::string_view kLongScrew = "acutrak_standard_1994_30";

/// A whole operation, as it is stored; of another mode on wish.
const Operated& operation() {
  static const Operated done = [] {
    simulation::Recorder recorder("test 1", simulation::fingerprint_of(wrist()), exercise(), 1);
    Operated made;
    simulation::World* world = nullptr;
    const auto note = [&] {
      const simulation::Snapshot& now = world->now();
      for (std::size_t i = 0; i < now.event_count; ++i) made.events.push_back(now.events[i]);
      if (simulation::is_keyframe_due(now) && now.tick > 0)
        recorder.append_keyframe({now.tick, world->write_state()});
    };
    Operator op([&](const simulation::Input& input) {
      if (world != nullptr) note();
      recorder.append(input);
    });
    world = &op.world();
    simulation::test::operate(op, kLongScrew);
    op.command(simulation::test::simple(simulation::CommandKind::Finish));
    note();
    made.recording = recorder.finished(op.now().state_hash);
    return made;
  }();
  return done;
}

class ReplayDeskTest : public ::testing::Test {
 protected:
  ReplayDeskTest()
      : desk_(wrist(), list_, [this](std::int64_t id) -> std::optional<records::Attempt> {
          ++loads_;
          if (id == 1) return attempt_;
          return std::nullopt;
        }) {
    procedure::ScoreReport score;
    std::vector<protocol::LoggedEvent> log;
    const session::Session session(wrist(), exercise(), {});
    for (const simulation::Event& event : operation().events) {
      log.push_back(session.describe(event));
    }
    attempt_ = make_attempt({wrist(), operation().recording, log, score, "Ada", "script", ""});
  }
  [[nodiscard]] std::vector<Json> states(std::int64_t from, std::int64_t to, std::int64_t every) {
    const HttpResponse response = desk_.states(1, {from, to, every});
    EXPECT_EQ(response.status, 200U) << *response.body;
    std::vector<Json> lines;
    std::istringstream in(*response.body);
    for (std::string line; std::getline(in, line);) lines.push_back(Json::parse(line));
    return lines;
  }
  [[nodiscard]] static Tick tick_of(simulation::EventKind kind) {
    for (const simulation::Event& event : operation().events) {
      if (event.kind == kind) return event.tick;
    }
    return 0;
  }
  [[nodiscard]] static Tick last_shot() {
    Tick last = 0;
    for (const simulation::Event& event : operation().events) {
      if (event.kind == simulation::EventKind::ShotTaken) last = event.tick;
    }
    return last;
  }
  void become_assessed(bool is_void) {
    simulation::Recording assessed = operation().recording;
    assessed.mode = procedure::Mode::Assessed;
    assessed.keyframes.clear();  // they are of a world in practice
    procedure::ScoreReport score;
    score.is_void = is_void;
    attempt_ = make_attempt({wrist(), assessed, {}, score, "Ada", "script", ""});
  }

  const procedure::ProcedureList list_{{&exercise()}};
  records::Attempt attempt_;
  int loads_ = 0;
  ReplayDesk desk_;
};

TEST_F(ReplayDeskTest, SaysOfAnyMomentWhatTheHostSaidThen) {
  const auto length = static_cast<std::int64_t>(operation().recording.tick_count());
  for (const std::int64_t from : {length - 40, std::int64_t{12'000}, std::int64_t{0}}) {
    const std::vector<Json> lines = states(from, from + 40, 20);
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_EQ(lines[0]["type"], "tissue");
    EXPECT_EQ(lines[1]["type"], "snapshot");
    EXPECT_EQ(lines[1]["tick"], from);
    EXPECT_EQ(lines[3]["tick"], from + 40);
    EXPECT_EQ(lines[1]["bodies"].size(), wrist().bones.size());
  }
  EXPECT_EQ(states(length, length + 500, 100).size(), 2U) << "nothing comes after its end";
  EXPECT_EQ(states(length, length, 1)[1]["state_hash"],
            hexadecimal(operation().recording.end_hash));
  EXPECT_EQ(loads_, 1) << "an attempt is read once";
  EXPECT_EQ(Json::parse(*desk_.exercise(1).body)["steps"].size(), exercise().steps.size());
}

TEST_F(ReplayDeskTest, MakesThePicturesAnew) {
  const Tick shot = tick_of(simulation::EventKind::ShotTaken);
  const Tick held = tick_of(simulation::EventKind::LiveEnded);
  ASSERT_GT(held, shot);
  const auto kind_of = [](const HttpResponse& response) {
    std::uint32_t kind = 99;
    if (response.body->size() > 12) std::memcpy(&kind, response.body->data() + 8, 4);
    return static_cast<PictureKind>(kind);
  };
  const HttpResponse taken = desk_.picture(1, static_cast<std::int64_t>(shot));
  EXPECT_EQ(kind_of(taken), PictureKind::Shot);
  EXPECT_EQ(kind_of(desk_.picture(1, static_cast<std::int64_t>(held))), PictureKind::Held);
  EXPECT_EQ(kind_of(desk_.picture(1, static_cast<std::int64_t>(held) - 50)), PictureKind::Live);
  EXPECT_EQ(*desk_.picture(1, static_cast<std::int64_t>(shot)).body, *taken.body)
      << "noise and all";
  EXPECT_EQ(desk_.picture(1, static_cast<std::int64_t>(shot) + 2).status, 404U);
}

TEST_F(ReplayDeskTest, TellsTheTruthOfAnAssessedAttemptOnceItIsFinishedAndNotVoid) {
  const auto end = static_cast<std::int64_t>(operation().recording.tick_count());
  become_assessed(false);
  EXPECT_EQ(Json::parse(*desk_.exercise(1).body)["mode"], "assessed");
  EXPECT_FALSE(states(end - 2000, end - 2000, 1)[0]["tracks"].empty());
  EXPECT_FALSE(states(end - 2000, end - 2000, 1)[1]["completed_steps"].empty());
}

TEST_F(ReplayDeskTest, KeepsTheTruthOfAVoidAttemptLocked) {
  become_assessed(true);
  const auto end = static_cast<std::int64_t>(operation().recording.tick_count());
  EXPECT_TRUE(states(end - 2000, end - 2000, 1).back()["completed_steps"].empty());
  EXPECT_EQ(desk_.views(1).status, 409U);
  EXPECT_EQ(desk_.truth(1, static_cast<std::int64_t>(last_shot())).status, 409U);
}

TEST_F(ReplayDeskTest, TellsWhatWasTrueOfAPictureAndWhichViewsShowTheScrew) {
  const auto first = static_cast<std::int64_t>(tick_of(simulation::EventKind::ShotTaken));
  const auto before = protocol::parse_picture_truth(*desk_.truth(1, first).body);
  ASSERT_TRUE(before.has_value()) << before.error();
  EXPECT_FALSE(before->bone.empty());
  EXPECT_TRUE(before->screws.empty());
  const auto last = static_cast<std::int64_t>(last_shot());
  const auto after = protocol::parse_picture_truth(*desk_.truth(1, last).body);
  ASSERT_TRUE(after.has_value()) << after.error();
  EXPECT_EQ(after->screws.size(), 1U);
  EXPECT_EQ(desk_.truth(1, last + 1).status, 404U);
  const auto views = protocol::parse_view_debrief(*desk_.views(1).body);
  ASSERT_TRUE(views.has_value()) << views.error();
  EXPECT_FALSE(views->screw.empty());
  ASSERT_FALSE(views->faults.empty()) << "30 mm of screw in the synthetic scaphoid";
  const auto& seen = views->faults.front().seen;
  EXPECT_EQ(seen.size(), view_trainer::standard_views().size() + 1);
  EXPECT_EQ(seen.back().tick, last);
  for (const auto& one : seen) EXPECT_LE(one.overhang_mm, views->faults.front().depth_mm + 0.2);
}

TEST_F(ReplayDeskTest, SaysWhyAnAttemptCannotBeShown) {
  EXPECT_EQ(desk_.states(2, {0, 1, 1}).status, 404U);
  for (const ReplayStretch bad : {ReplayStretch{0, 1, 0}, ReplayStretch{5, 1, 1},
                                  ReplayStretch{0, 1000, 1}, ReplayStretch{0, 100'000, 1000}}) {
    EXPECT_EQ(desk_.states(1, bad).status, 400U);
  }
  attempt_.summary.case_fingerprint.back() ^= 1;
  const HttpResponse elsewhere = desk_.states(1, {0, 1, 1});
  EXPECT_EQ(elsewhere.status, 409U);
  EXPECT_NE(elsewhere.body->find("another case"), std::string::npos);
}

TEST_F(ReplayDeskTest, PaintsNoCartilageWhereNobodyLookedIntoAJoint) {
  EXPECT_EQ(desk_.cartilage(2).status, 404U);
  EXPECT_EQ(desk_.cartilage(1).status, 404U);
  become_assessed(true);
  ReplayDesk closed(wrist(), list_, [this](std::int64_t) { return attempt_; });
  EXPECT_EQ(closed.cartilage(1).status, 409U) << "the truth of what does not count";
}

TEST_F(ReplayDeskTest, SaysThatARecordingIsDamaged) {
  attempt_.recording.resize(attempt_.recording.size() / 2);
  EXPECT_EQ(desk_.exercise(1).status, 409U);
}

}  // namespace
}  // namespace carpus::server
