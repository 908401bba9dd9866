// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/replay_player.hpp"

#include <gtest/gtest.h>

#include <map>

#include "simulation/keyframe_due.hpp"
#include "simulation/operation_test_support.hpp"

namespace carpus::simulation {
namespace {

using test::exercise;
using test::Operator;
using test::wrist;

/// A recording with its keyframes, and what the state's hash was after every tick.
struct Recorded {
  std::shared_ptr<const Recording> recording;
  std::map<Tick, std::uint64_t> hashes;
};

Recorded record(const std::function<void(Operator&)>& operate) {
  Recorder recorder("test 1", 1, exercise(), 1);
  Recorded made;
  World* world = nullptr;
  const auto note = [&] {
    const Snapshot& now = world->now();
    if (now.tick == 0) return;
    made.hashes[now.tick] = now.state_hash;
    if (is_keyframe_due(now)) recorder.append_keyframe({now.tick, world->write_state()});
  };
  Operator op([&](const Input& input) {
    if (world != nullptr) note();
    recorder.append(input);
  });
  world = &op.world();
  operate(op);
  note();
  made.recording = std::make_shared<Recording>(recorder.finished(op.now().state_hash));
  return made;
}

TEST(ReplayPlayer, ShowsAnyMomentForwardsAndBackwards) {
  const Recorded done = record([](Operator& op) { test::operate(op); });
  ReplayPlayer player(wrist(), exercise(), done.recording);
  EXPECT_EQ(player.length(), done.recording->tick_count());
  for (const Tick tick : {12'345, 12'346, 12'400, 25'000, 9'999, 10'000, 10'001, 300, 21'000}) {
    ASSERT_TRUE(player.seek(tick).has_value());
    EXPECT_EQ(player.now().tick, tick);
    EXPECT_EQ(player.now().state_hash, done.hashes.at(tick)) << tick;
  }
  ASSERT_TRUE(player.seek(0).has_value());
  EXPECT_EQ(player.now().tick, 0U);
  ASSERT_TRUE(player.seek(player.length() + 5).has_value());
  EXPECT_EQ(player.now().state_hash, done.recording->end_hash);
}

TEST(ReplayPlayer, TellsTheEventsOfATickThatIsAKeyframe) {
  const Recorded done = record([](Operator& op) {
    op.hold(Driver::Off, 0.0, static_cast<int>(kKeyframeTicks - op.now().tick) - 1);
    op.command(test::shot(30));
    op.hold(Driver::Off, 0.0, 5);
  });
  ReplayPlayer player(wrist(), exercise(), done.recording);
  ASSERT_TRUE(player.seek_with_events(kKeyframeTicks).has_value());
  ASSERT_EQ(player.now().event_count, 1);
  EXPECT_EQ(player.now().events[0].kind, EventKind::ShotTaken);
  EXPECT_EQ(player.input().command.rotation_deg, 30);
}

TEST(ReplayPlayer, ShowsWhatAnUndoWentBackToThoughThatLiesBeforeTheKeyframe) {
  const Recorded done = record([](Operator& op) {
    op.place_on_entry({});
    op.drive_to(10.0);
    op.hold(Driver::Off, 0.0, static_cast<int>(kKeyframeTicks - op.now().tick) + 500);
    op.command(test::simple(CommandKind::Undo));
    op.hold(Driver::Off, 0.0, 700);
  });
  const Tick undone = kKeyframeTicks + 501;
  ASSERT_EQ(done.recording->keyframes.size(), 2U);
  EXPECT_EQ(done.recording->keyframes.back().tick, undone);
  for (const bool crosses : {true, false}) {
    ReplayPlayer player(wrist(), exercise(), done.recording);
    if (crosses) {
      ASSERT_TRUE(player.seek(kKeyframeTicks + 100).has_value());
    }
    for (const Tick tick : {undone, undone + 600}) {
      ASSERT_TRUE(player.seek(tick).has_value());
      EXPECT_EQ(player.now().state_hash, done.hashes.at(tick)) << tick << crosses;
      EXPECT_EQ(player.now().undos, 1U);
    }
    ASSERT_TRUE(player.seek(undone - 1).has_value());
    ASSERT_TRUE(player.seek_with_events(undone).has_value());
    EXPECT_EQ(player.now().state_hash, done.hashes.at(undone));
  }
}

TEST(ReplayPlayer, RefusesAKeyframeThatIsNone) {
  Recording spoilt = *record([](Operator& op) { op.hold(Driver::Off, 0, 10'100); }).recording;
  ASSERT_EQ(spoilt.keyframes.size(), 1U);
  spoilt.keyframes.front().state[40] ^= std::byte{1};
  ReplayPlayer player(wrist(), exercise(), std::make_shared<Recording>(spoilt));
  EXPECT_TRUE(player.seek(5'000).has_value());
  EXPECT_FALSE(player.seek(10'050).has_value());
}

}  // namespace
}  // namespace carpus::simulation
