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
    now.tip_in_patient = input.tip_in_patient;
    now.event_count = 0;
    if (input.command.kind == CommandKind::TakeShot) {
      now.event_count = 1;
      now.events[0] = {EventKind::ShotTaken, static_cast<std::int32_t>(++now.shots), 0.0, now.tick};
    }
    now.finished = input.command.kind == CommandKind::Finish;
    return now;
  }
};

std::unique_ptr<SimulationLoop> run(CountingWorld& world) {
  return std::make_unique<SimulationLoop>(
      [&world](const Input& input) -> const Snapshot& { return world.step(input); }, world.now);
}

Snapshot wait_for(SimulationLoop& loop, const std::function<bool(const Snapshot&)>& fits) {
  LoopState state;
  for (int i = 0; i < 5000; ++i) {
    if (loop.take_state(state) && fits(state.snapshot)) return state.snapshot;
    std::this_thread::sleep_for(1ms);
  }
  ADD_FAILURE() << "waited for 5 s in vain";
  return state.snapshot;
}

TEST(SimulationLoop, KeepsTimeAndMeasuresIt) {
  CountingWorld world;
  const auto loop = run(world);
  std::this_thread::sleep_for(1500ms);
  loop->stop();
  LoopState state;
  ASSERT_TRUE(loop->take_state(state));
  // On a busy machine ticks are late but made up for; only long stops are given up.
  EXPECT_NEAR(static_cast<double>(state.snapshot.tick), 1500.0, 300.0);
  EXPECT_NEAR(state.timing.rate_hz, 1000.0, 200.0);
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
    loop->hold({{static_cast<double>(i), 0, 0}, {0, 0, 1}, 0.0, simulation::Driver::Off});
    std::this_thread::sleep_for(1ms);
  }
  (void)wait_for(*loop, [](const Snapshot& s) { return s.tip_in_patient.x == 50.0; });
  loop->stop();
  double previous = 0.0;
  std::uint64_t count = 0;
  while (const auto input = loop->next_input()) {
    EXPECT_GE(input->tip_in_patient.x, previous);
    previous = input->tip_in_patient.x;
    ++count;
  }
  EXPECT_EQ(previous, 50.0);
  EXPECT_EQ(count, world.now.tick);
}

TEST(SimulationLoop, DriverStopsWhenNobodySaysThatItIsHeld) {
  CountingWorld world;
  const auto loop = run(world);
  loop->hold({{7, 0, 0}, {0, 0, 1}, 20.0, simulation::Driver::Forward});
  const Snapshot held = wait_for(*loop, [](const Snapshot& s) { return s.tip_in_patient.x == 7; });
  (void)wait_for(*loop, [&](const Snapshot& s) { return s.tick > held.tick + 300; });
  loop->stop();
  Tick driven = 0;
  while (const auto input = loop->next_input()) {
    driven += input->driver == simulation::Driver::Forward ? 1 : 0;
  }
  EXPECT_EQ(driven, SimulationLoop::kDriverHoldTicks);
}

TEST(SimulationLoop, CommandsAreDoneInOrderAndTheirTicksDelivered) {
  CountingWorld world;
  const auto loop = run(world);
  for (int i = 0; i < 20; ++i) {
    Command shot{CommandKind::TakeShot, 0, static_cast<double>(i), 0.0};
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
  ASSERT_TRUE(loop->command({CommandKind::Finish, 0, 0.0, 0.0}));
  const Snapshot finished = wait_for(*loop, [](const Snapshot& s) { return s.finished; });
  std::this_thread::sleep_for(20ms);
  loop->stop();
  EXPECT_EQ(world.now.tick, finished.tick);
}

TEST(SimulationLoop, TimeStandsStillRatherThanLosingWhatWasDone) {
  CountingWorld world;
  const auto loop = run(world);
  loop->pause(true);
  std::this_thread::sleep_for(10ms);
  // More shots than the ring of eventful ticks holds, never drained meanwhile.
  loop->pause(false);
  int sent = 0;
  for (int i = 0; i < 600 && sent < 400; ++i) {
    if (loop->command({CommandKind::TakeShot, 0, 0.0, 0.0})) {
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
  EXPECT_GT(sent, 256 + 64);
}

}  // namespace
}  // namespace carpus::server
