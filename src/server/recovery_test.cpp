// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/recovery.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "protocol/bodies.hpp"
#include "records/journals_left_behind.hpp"
#include "server/journal_test_support.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using simulation::test::exercise;
using simulation::test::wrist;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::ScriptedExercise;

class RecoveryTest : public ::testing::Test {
 protected:
  RecoveryTest() {
    std::string name = (fs::temp_directory_path() / "carpus-recovery-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    records_ = folder_ / "attempts.sqlite";
  }
  ~RecoveryTest() override { fs::remove_all(folder_); }

  /// An exercise that was begun, went so far and was left. @param last  tick of its Finish.
  std::string leave(Tick ticks, Tick last = 0, std::uint64_t fingerprint = 0) {
    ScriptedExercise left(records_, fingerprint);
    for (Tick i = 0; i < ticks; ++i) left.step(last);
    (void)left.end();
    EXPECT_TRUE(left.journal().wait_until_safe(10s));
    return left.origin();
  }

  LeftBehind look(const std::string& stored = "none") {
    static const procedure::ProcedureList procedures({&exercise()});
    static const std::uint64_t fingerprint = simulation::fingerprint_of(wrist());
    return look_for_what_was_left(
        wrist(), fingerprint, procedures, records_,
        [&](const std::string& origin) { return origin == stored; }, 3);
  }
  [[nodiscard]] std::size_t journals() const {
    return records::files_beside(records_, ".running-", ".journal").size();
  }

  fs::path folder_;
  fs::path records_;
};

TEST_F(RecoveryTest, AnExerciseStandsWhereItsJournalEnds) {
  const std::string origin = leave(12'345);
  LeftBehind left = look();
  ASSERT_NE(left.running, nullptr);
  EXPECT_THAT(left.ended, IsEmpty());
  ASSERT_EQ(left.words.size(), 1U);
  EXPECT_THAT(left.words[0], HasSubstr("12 s long, goes on"));
  const ExerciseStart& start = left.running->start;
  EXPECT_EQ(start.world.now().tick, 12'346U) << "with one tick in which nobody does anything";
  EXPECT_EQ(start.shadow.now().state_hash, start.world.now().state_hash);
  EXPECT_EQ(start.recorder.tick(), 12'346U);
  EXPECT_EQ(start.origin, origin);
  EXPECT_EQ(start.log.back().kind, "station_restarted");
  EXPECT_TRUE(start.paused);
  EXPECT_EQ(left.running->owner, "first");
  EXPECT_EQ(left.running->setup.trainee, "Ada");
  EXPECT_EQ(left.running->setup.number, 1234567U);
  ASSERT_EQ(left.running->shots.size(), 3U) << "the last, oldest first";
  EXPECT_EQ(left.running->shots[2].snapshot.tick, 12'251U);
  EXPECT_EQ(left.running->shots[2].rotation_deg, 30);
  EXPECT_LT(left.running->shots[0].number, left.running->shots[2].number);
  EXPECT_THAT(look().running, ::testing::IsNull()) << "it is in use now";
}

/// Goes on for so many ticks, as a station does.
void go_on(ExerciseStart& start, int ticks, const simulation::Command& first = {}) {
  for (int i = 0; i < ticks; ++i) {
    auto input = testing::scripted_input(start.world.now(), 0);
    if (i == 0 && first.kind != simulation::CommandKind::None) input.command = first;
    start.recorder.append(input);
    start.world.step(input);
    start.journal->append(input);
    start.journal->hand_over(start.world.now().state_hash);
  }
  start.journal->hand_over_now(start.world.now().state_hash);
  EXPECT_TRUE(start.journal->wait_until_safe(10s));
}

/// Whether the inputs lead from the beginning to where the world is.
bool replays(const ExerciseStart& start) {
  return simulation::replay(wrist(), exercise(),
                            start.recorder.finished(start.world.now().state_hash))
      .hash_matches;
}

TEST_F(RecoveryTest, WhatWasGoneOnWithCanBeLeftAgain) {
  const std::string origin = leave(10'400);
  for (const Tick expected : {Tick{10'401}, Tick{10'902}, Tick{11'403}}) {
    LeftBehind left = look();
    ASSERT_NE(left.running, nullptr);
    ASSERT_EQ(left.running->start.world.now().tick, expected);
    go_on(left.running->start, 500);
    EXPECT_TRUE(replays(left.running->start));
  }
}

const simulation::Command kTake = simulation::test::take("probe", 1);
const simulation::Command kUndo = {simulation::CommandKind::Undo};

TEST_F(RecoveryTest, UndoThatWentBackBeyondAKeyframeIsFollowed) {
  ScriptedExercise left_running(records_);
  // Something is done before the keyframe of 10 s, the next of 20 s, and undone after it.
  for (Tick i = 0; i < 21'000; ++i) {
    left_running.step(0, i == 9000 ? kTake : (i == 20'500 ? kUndo : simulation::Command{}));
  }
  EXPECT_EQ(left_running.now().undos, 1U);
  (void)left_running.end();
  EXPECT_TRUE(left_running.journal().wait_until_safe(10s));
  left_running.take_journal().reset();
  const LeftBehind left = look();
  ASSERT_NE(left.running, nullptr) << left.words[0];
  EXPECT_EQ(left.running->start.world.now().tick, 21'001U);
  EXPECT_TRUE(replays(left.running->start));
}

TEST_F(RecoveryTest, UndoDoesNotReachBackBeforeTheStationWasStartedAgain) {
  ScriptedExercise left_running(records_);
  for (Tick i = 0; i < 10'500; ++i) left_running.step(0, i == 9000 ? kTake : simulation::Command{});
  EXPECT_TRUE(left_running.now().can_undo);
  (void)left_running.end();
  EXPECT_TRUE(left_running.journal().wait_until_safe(10s));
  left_running.take_journal().reset();
  LeftBehind left = look();
  ASSERT_NE(left.running, nullptr);
  ExerciseStart& start = left.running->start;
  EXPECT_FALSE(start.world.now().can_undo);
  EXPECT_THAT(start.log.back().text, HasSubstr("undo does not reach back"));
  // Asked for nevertheless it is refused, now and in a replay from the beginning.
  go_on(start, 100, kUndo);
  EXPECT_EQ(start.world.now().undos, 0U);
  EXPECT_TRUE(replays(start));
}

TEST_F(RecoveryTest, WhatIsStoredAlreadyIsNotStoredTwice) {
  const std::string origin = leave(500, 500);
  const LeftBehind left = look(origin);
  EXPECT_EQ(left.running, nullptr);
  EXPECT_THAT(left.ended, IsEmpty());
  EXPECT_EQ(journals(), 0U);
}

TEST_F(RecoveryTest, AFinishedOperationIsScored) {
  leave(1500, 1500);
  const LeftBehind left = look();
  EXPECT_EQ(left.running, nullptr);
  ASSERT_EQ(left.ended.size(), 1U);
  const records::Attempt& attempt = left.ended[0].attempt;
  EXPECT_EQ(attempt.summary.outcome, records::Outcome::Finished);
  EXPECT_EQ(attempt.summary.overall, 100);
  EXPECT_TRUE(protocol::parse_stored_score(attempt.score_json).has_value());
  const auto decoded = simulation::decode(attempt.recording);
  ASSERT_TRUE(decoded.has_value()) << decoded.error();
  EXPECT_TRUE(simulation::replay(wrist(), exercise(), *decoded).hash_matches);
  left.ended[0].journal->remove();
  EXPECT_EQ(journals(), 0U);
}

TEST_F(RecoveryTest, OfSeveralTheNewestGoesOnAndTheOthersAreStored) {
  leave(600);
  std::this_thread::sleep_for(5ms);
  const std::string newest = leave(700);
  const LeftBehind left = look();
  ASSERT_NE(left.running, nullptr);
  EXPECT_EQ(left.running->start.origin, newest);
  ASSERT_EQ(left.ended.size(), 1U);
  EXPECT_EQ(left.ended[0].attempt.summary.outcome, records::Outcome::Unfinished);
  EXPECT_EQ(left.ended[0].attempt.summary.duration_ticks, 600U);
}

TEST_F(RecoveryTest, OneOfAnotherCaseIsStoredAsItIs) {
  leave(600, 0, 4711);
  const LeftBehind left = look();
  EXPECT_EQ(left.running, nullptr);
  ASSERT_EQ(left.ended.size(), 1U);
  EXPECT_EQ(left.ended[0].attempt.summary.case_fingerprint, "0000000000001267");
  ASSERT_EQ(left.words.size(), 1U);
  EXPECT_THAT(left.words[0], HasSubstr("another case"));
}

TEST_F(RecoveryTest, OneThatDoesNotReplayIsStoredAsItIs) {
  ScriptedExercise left_running(records_);
  for (int i = 0; i < 600; ++i) left_running.step(0);
  left_running.journal().append(simulation::Input{});
  left_running.journal().hand_over_now(4711);  // no such state
  EXPECT_TRUE(left_running.journal().wait_until_safe(10s));
  left_running.take_journal().reset();
  const LeftBehind left = look();
  EXPECT_EQ(left.running, nullptr);
  ASSERT_EQ(left.ended.size(), 1U);
  EXPECT_THAT(left.words[0], HasSubstr("do not lead to its state"));
}

TEST_F(RecoveryTest, WhatCannotBeReadIsSetAsideWithAWord) {
  std::ofstream(records::journal_path(records_, "abc")) << "no journal";
  std::ofstream(records::journal_path(records_, "abd")) << std::string(5000, '\0');
  const LeftBehind left = look();
  EXPECT_EQ(left.running, nullptr);
  ASSERT_EQ(left.words.size(), 2U);
  EXPECT_THAT(left.words[0], HasSubstr("kept as"));
  EXPECT_EQ(journals(), 0U);
  EXPECT_THAT(look().words, IsEmpty()) << "said once";
}

TEST_F(RecoveryTest, AnExerciseWithoutATickIsDeletedWithAWord) {
  {
    const ScriptedExercise left(records_);
    std::this_thread::sleep_for(50ms);
  }
  const LeftBehind left = look();
  ASSERT_EQ(left.words.size(), 1U);
  EXPECT_THAT(left.words[0], HasSubstr("nothing was done"));
  EXPECT_EQ(journals(), 0U);
}

TEST_F(RecoveryTest, AJournalThatWasCutOffAtItsBeginningIsDeletedWithAWord) {
  std::ofstream(records::journal_path(records_, "abc"));
  std::ofstream(records::journal_path(records_, "abd")) << "CARPJRN1 and half a head";
  const LeftBehind left = look();
  EXPECT_EQ(left.words.size(), 2U);
  EXPECT_EQ(journals(), 0U);
  EXPECT_TRUE(records::files_beside(records_, ".running-", "").empty());
}

TEST_F(RecoveryTest, WhateverIsCutOffGoesOnFromThePartBefore) {
  leave(2600);
  const fs::path file = records::files_beside(records_, ".running-", ".journal").front();
  const auto size = fs::file_size(file);
  Tick most = 0;
  for (std::uintmax_t cut = size; cut > 100; cut -= size / 5) {
    fs::resize_file(file, cut);
    LeftBehind left = look();
    const auto& words = left.words;
    if (left.running == nullptr) {
      ASSERT_FALSE(words.empty()) << cut;
      break;
    }
    const Tick tick = left.running->start.world.now().tick;
    EXPECT_TRUE(most == 0 || tick <= most);
    most = tick;
    left.running->start.journal.reset();
    fs::resize_file(file, cut);
  }
}

}  // namespace
}  // namespace carpus::server
