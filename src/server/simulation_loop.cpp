// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/simulation_loop.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <utility>

namespace carpus::server {

namespace {

/// Above ordinary programs, below the kernel's own threads.
constexpr int kRealTimePriority = 20;

bool request_real_time_priority() noexcept {
  sched_param parameters{};
  parameters.sched_priority = kRealTimePriority;
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace

SimulationLoop::SimulationLoop(Step step, const simulation::Snapshot& initial)
    : step_(std::move(step)) {
  state_.snapshot = initial;
  tool_.tip_in_patient = initial.tip_in_patient;
  tool_.shaft_in_patient = initial.shaft_in_patient;
  thread_ = std::thread([this] { run(); });
}

SimulationLoop::~SimulationLoop() { stop(); }

void SimulationLoop::stop() {
  stopping_.store(true, std::memory_order_relaxed);
  if (thread_.joinable()) thread_.join();
}

RealTimeGrants SimulationLoop::grants() const noexcept {
  return {memory_locked_.load(std::memory_order_relaxed),
          real_time_priority_.load(std::memory_order_relaxed)};
}

void SimulationLoop::run() noexcept {
  // Current memory only: with MCL_FUTURE a small limit would make later allocations fail.
  memory_locked_.store(::mlockall(MCL_CURRENT) == 0, std::memory_order_relaxed);
  real_time_priority_.store(request_real_time_priority(), std::memory_order_relaxed);
  states_.publish(state_);
  clock_.start();
  while (!stopping_.load(std::memory_order_relaxed)) {
    clock_.wait();
    const bool is_running = !paused_.load(std::memory_order_relaxed) && !state_.snapshot.finished;
    clock_.work_done(is_running && tick());
    state_.timing = clock_.timing();
    states_.publish(state_);
  }
}

/// Whether the last eventful tick has left; time waits for it, so that no event is ever lost.
bool SimulationLoop::has_delivered() noexcept {
  if (undelivered_ && eventful_.push(*undelivered_)) undelivered_.reset();
  return !undelivered_;
}

bool SimulationLoop::tick() noexcept {
  if (!has_delivered()) return false;
  ticks_since_heard_ = held_.take(tool_) ? 0 : ticks_since_heard_ + 1;
  const bool is_heard = ticks_since_heard_ < kDriverHoldTicks;
  if (!next_command_) next_command_ = commands_.pop();
  const simulation::Command command = next_command_.value_or(simulation::Command{});
  const simulation::Input input{tool_.tip_in_patient, tool_.shaft_in_patient, tool_.thrust_n,
                                is_heard ? tool_.driver : simulation::Driver::Off, command};
  // The input is on its way to the recording before it is used: what cannot be recorded does not
  // happen.
  if (!inputs_.push(input)) return false;
  next_command_.reset();
  state_.snapshot = step_(input);
  if (state_.snapshot.event_count > 0 || command.kind != simulation::CommandKind::None) {
    undelivered_ = EventfulTick{command, state_.snapshot};
    (void)has_delivered();
  }
  return true;
}

}  // namespace carpus::server
