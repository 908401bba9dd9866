// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/simulation_loop.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace carpus::server {
namespace {

using namespace std::chrono_literals;
using simulation::Command;
using simulation::CommandKind;
using simulation::EventKind;
using simulation::Input;
using simulation::Snapshot;

/// Counts ticks; every command is an event; Finish finishes.
struct CountingWorld {
  Snapshot now;
  const Snapshot& step(const Input& input) {
    ++now.tick;
    now.wrist = input.wrist;
    now.hands[0].force_in_patient = {0, 1, 0};
    now.event_count = 0;
    if (input.command.kind == CommandKind::TakeShot) {
      now.event_count = 1;
      now.events[0].kind = EventKind::ShotTaken;
      now.events[0].detail = static_cast<std::int32_t>(++now.shots);
    }
    now.finished = input.command.kind == CommandKind::Finish;
    return now;
  }
};

/// The wrist's traction is a mark that comes back in the snapshot.
session::HeldInput marked(double mark) {
  session::HeldInput held;
  held.wrist.traction_n = mark;
  return held;
}

std::unique_ptr<SimulationLoop> run(CountingWorld& world) {
  return std::make_unique<SimulationLoop>(
      [&world](const Input& input) -> const Snapshot& { return world.step(input); }, world.now,
      session::HeldInput{});
}

Snapshot wait_for(SimulationLoop& loop,
                  const std::function<bool(const Snapshot&)>& fits,
                  int milliseconds = 5000) {
  LoopState state;
  for (int i = 0; i < milliseconds; ++i) {
    if (loop.take_state(state) && fits(state.snapshot)) return state.snapshot;
    std::this_thread::sleep_for(1ms);
  }
  ADD_FAILURE() << "waited for " << milliseconds << " ms in vain";
  return state.snapshot;
}

// How many ticks a clock gives is TickClock's matter, tested there; here, that the loop goes by it.
TEST(SimulationLoop, NeverRunsAheadAndMeasuresWhatItDoes) {
  CountingWorld world;
  const auto began = std::chrono::steady_clock::now();
  const auto loop = run(world);
  LoopState state;
  for (int i = 0; i < 60'000 && state.snapshot.tick < 1500; ++i) {
    std::this_thread::sleep_for(1ms);
    (void)loop->take_state(state);
  }
  EXPECT_LE(state.snapshot.tick * 1ms, std::chrono::steady_clock::now() - began);
  ASSERT_GE(state.snapshot.tick, 1500U) << "in a minute";
  EXPECT_EQ(state.timing.ticks, state.snapshot.tick);
  EXPECT_GT(state.timing.rate_hz, 0.0);
  EXPECT_GT(state.timing.p50_us, 0.0);
  EXPECT_GE(state.timing.p99_us, state.timing.p50_us);
  EXPECT_GE(state.timing.worst_us, state.timing.p99_us);
}

TEST(SimulationLoop, MeasuresNoPauses) {
  CountingWorld world;
  const auto loop = run(world);
  (void)wait_for(*loop, [](const Snapshot& s) { return s.tick > 200; });
  loop->pause(true);
  std::this_thread::sleep_for(300ms);
  loop->stop();
  LoopState state;
  ASSERT_TRUE(loop->take_state(state));
  EXPECT_EQ(state.timing.ticks, state.snapshot.tick);
  EXPECT_EQ(state.timing.rate_hz, 0.0);
  EXPECT_GT(state.timing.whole_p50_us, 0.0);
  EXPECT_GE(state.timing.whole_p99_us, state.timing.whole_p50_us);
}

TEST(SimulationLoop, HandsOutEveryInputInOrderWithoutGaps) {
  CountingWorld world;
  const auto loop = run(world);
  for (int i = 1; i <= 50; ++i) {
    loop->hold(marked(i));
    std::this_thread::sleep_for(1ms);
  }
  (void)wait_for(*loop, [](const Snapshot& s) { return s.wrist.traction_n == 50.0; });
  loop->stop();
  double previous = 0.0;
  std::uint64_t count = 0;
  while (const auto input = loop->next_input()) {
    EXPECT_GE(input->wrist.traction_n, previous);
    previous = input->wrist.traction_n;
    ++count;
  }
  EXPECT_EQ(previous, 50.0);
  EXPECT_EQ(count, world.now.tick);
}

TEST(SimulationLoop, DriverStopsWhenNobodySaysThatItIsHeld) {
  CountingWorld world;
  const auto loop = run(world);
  session::HeldInput drilling = marked(7);
  drilling.hands[1].driver = simulation::Driver::Forward;
  drilling.heard[1] = 1;
  loop->hold(drilling);
  const Snapshot held = wait_for(*loop, [](const Snapshot& s) { return s.wrist.traction_n == 7; });
  (void)wait_for(*loop, [&](const Snapshot& s) { return s.tick > held.tick + 300; });
  loop->stop();
  Tick driven = 0;
  while (const auto input = loop->next_input()) {
    driven += input->hands[1].driver == simulation::Driver::Forward ? 1 : 0;
  }
  EXPECT_EQ(driven, session::InputSource::kDriverHoldTicks);
}

TEST(SimulationLoop, CommandsAreDoneInOrderAndTheirTicksDelivered) {
  CountingWorld world;
  const auto loop = run(world);
  for (int i = 0; i < 20; ++i) {
    Command shot{CommandKind::TakeShot};
    shot.rotation_deg = i;
    ASSERT_TRUE(loop->command(shot));
  }
  (void)wait_for(*loop, [](const Snapshot& s) { return s.shots == 20; });
  loop->stop();
  for (int i = 0; i < 20; ++i) {
    const auto tick = loop->next_eventful_tick();
    ASSERT_TRUE(tick.has_value());
    EXPECT_EQ(tick->command.rotation_deg, i);
    EXPECT_EQ(tick->snapshot.shots, static_cast<std::uint32_t>(i + 1));
  }
  EXPECT_FALSE(loop->next_eventful_tick().has_value());
}

TEST(SimulationLoop, NoTimePassesWhilePausedOrAfterTheEnd) {
  CountingWorld world;
  const auto loop = run(world);
  (void)wait_for(*loop, [](const Snapshot& s) { return s.tick > 5; });
  loop->pause(true);
  std::this_thread::sleep_for(20ms);
  LoopState state;
  (void)loop->take_state(state);
  const auto paused_at = state.snapshot.tick;
  std::this_thread::sleep_for(50ms);
  ASSERT_TRUE(loop->take_state(state));
  EXPECT_EQ(state.snapshot.tick, paused_at);
  loop->pause(false);
  ASSERT_TRUE(loop->command({CommandKind::Finish}));
  const Snapshot finished = wait_for(*loop, [](const Snapshot& s) { return s.finished; });
  std::this_thread::sleep_for(20ms);
  loop->stop();
  EXPECT_EQ(world.now.tick, finished.tick);
}

TEST(SimulationLoop, AsksForNoForceWhilePausedOrStalledOrAfterTheEnd) {
  const auto is_pushed = [](const Snapshot& s) { return s.hands[0].force_in_patient.y > 0; };
  const auto is_free = [](const Snapshot& s) { return s.hands[0].force_in_patient == Vec3{}; };
  CountingWorld world;
  const auto loop = run(world);
  (void)wait_for(*loop, is_pushed);
  loop->pause(true);
  (void)wait_for(*loop, is_free);
  loop->pause(false);
  (void)wait_for(*loop, is_pushed);
  // Nobody takes the inputs: time comes to a standstill by itself.
  const Snapshot stalled = wait_for(
      *loop, [&](const Snapshot& s) { return is_free(s) && s.tick > 0; }, 15'000);
  EXPECT_EQ(stalled.tick, SimulationLoop::kMaxUndrained);
  while (loop->next_input()) {
  }
  (void)wait_for(*loop, is_pushed);
  ASSERT_TRUE(loop->command({CommandKind::Finish}));
  (void)wait_for(*loop, [&](const Snapshot& s) { return s.finished && is_free(s); });
}

TEST(SimulationLoop, TimeStandsStillRatherThanLosingWhatWasDone) {
  CountingWorld world;
  const auto loop = run(world);
  loop->pause(true);
  std::this_thread::sleep_for(10ms);
  // More shots than the rings of eventful ticks and of commands hold, never drained meanwhile.
  loop->pause(false);
  constexpr int kHeld = 256 + 64;
  int sent = 0;
  for (int i = 0; i < 5000 && sent <= kHeld; ++i) {
    if (loop->command({CommandKind::TakeShot})) {
      ++sent;
    } else {
      std::this_thread::sleep_for(1ms);
    }
  }
  std::uint32_t delivered = 0;
  for (int i = 0; i < 5000 && delivered < static_cast<std::uint32_t>(sent); ++i) {
    while (const auto tick = loop->next_eventful_tick()) {
      EXPECT_EQ(tick->snapshot.shots, ++delivered);
    }
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(delivered, static_cast<std::uint32_t>(sent));
  EXPECT_GT(sent, kHeld);
}

}  // namespace
}  // namespace carpus::server
