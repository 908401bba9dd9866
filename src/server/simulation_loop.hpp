// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The 1 kHz thread: steps one simulation by the clock. It shares nothing with other threads but
// rings and triple buffers; in the loop it neither allocates, locks, logs nor throws.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>

#include "core/latest_value.hpp"
#include "core/spsc_ring.hpp"
#include "server/tick_guest.hpp"
#include "server/tick_timing.hpp"
#include "session/held_input.hpp"
#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::server {

/// A tick in which something happened, with what was commanded in it.
struct EventfulTick {
  simulation::Command command;
  simulation::Snapshot snapshot;
};

/// What leaves the thread after each tick.
struct LoopState {
  simulation::Snapshot snapshot;
  TickTiming timing;
};

/// Which real-time privileges the system granted; without them the loop runs all the same.
struct RealTimeGrants {
  bool memory_locked = false;
  bool real_time_priority = false;
};

/// But for construction and destruction, all may be called while the thread runs, from one other
/// thread.
class SimulationLoop {
 public:
  /// Advances the simulation by one tick; called in the loop's thread only, must not throw.
  using Step = std::function<const simulation::Snapshot&(const simulation::Input&)>;

  /// Starts the thread. @param initial  state before the first tick. @param held, paused  until
  /// told otherwise. @param guest  takes part in each tick; must outlive this.
  SimulationLoop(Step step,
                 const simulation::Snapshot& initial,
                 const session::HeldInput& held,
                 bool paused = false,
                 TickGuest* guest = nullptr);
  ~SimulationLoop();
  SimulationLoop(const SimulationLoop&) = delete;
  SimulationLoop& operator=(const SimulationLoop&) = delete;

  /// The newest counts.
  void hold(const session::HeldInput& held) noexcept { held_.publish(held); }
  /// Done in order, one a tick. False when too many wait.
  [[nodiscard]] bool command(const simulation::Command& command) noexcept {
    return commands_.push(command);
  }
  /// While paused no ticks pass and no force is asked for.
  void pause(bool on) noexcept { paused_.store(on, std::memory_order_relaxed); }

  /// True when there is a newer state than at the last call.
  [[nodiscard]] bool take_state(LoopState& state) noexcept { return states_.take(state); }
  /// Every tick's input, in order and without gaps. When kMaxUndrained wait, time stands still
  /// until some are taken.
  [[nodiscard]] std::optional<simulation::Input> next_input() noexcept { return inputs_.pop(); }
  /// Every tick in which something happened.
  [[nodiscard]] std::optional<EventfulTick> next_eventful_tick() noexcept {
    return eventful_.pop();
  }

  /// Ends the thread and waits for it; what it did can be drained afterwards.
  void stop();

  /// Known once the first state was taken.
  [[nodiscard]] RealTimeGrants grants() const noexcept;

  /// About 8 s of ticks.
  static constexpr std::size_t kMaxUndrained = 8192;

 private:
  void run() noexcept;
  [[nodiscard]] bool tick() noexcept;  ///< false: nothing was simulated
  [[nodiscard]] bool has_delivered() noexcept;
  void ask_for_no_force() noexcept;

  // The thread's own.
  Step step_;
  TickGuest* guest_;
  session::InputSource source_;
  LoopState state_;
  std::optional<simulation::Command> next_command_;
  std::optional<EventfulTick> undelivered_;  ///< waits for room in the ring
  TickClock clock_;

  // Shared.
  LatestValue<session::HeldInput> held_;
  LatestValue<LoopState> states_;
  SpscRing<simulation::Command, 64> commands_;
  SpscRing<simulation::Input, kMaxUndrained> inputs_;
  SpscRing<EventfulTick, 256> eventful_;
  std::atomic<bool> paused_{false};
  std::atomic<bool> stopping_{false};
  std::atomic<bool> memory_locked_{false};
  std::atomic<bool> real_time_priority_{false};
  std::thread thread_;
};

}  // namespace carpus::server
