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

SimulationLoop::SimulationLoop(Step step,
                               const simulation::Snapshot& initial,
                               const session::HeldInput& held,
                               bool paused,
                               TickGuest* guest)
    : step_(std::move(step)), guest_(guest), source_(held), paused_(paused) {
  state_.snapshot = initial;
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
    const bool has_passed = is_running && tick();
    clock_.work_done(has_passed);
    if (!has_passed) ask_for_no_force();
    state_.timing = clock_.timing();
    states_.publish(state_);
  }
}

/// Whether the last eventful tick has left; time waits for it, so that no event is ever lost.
bool SimulationLoop::has_delivered() noexcept {
  if (undelivered_ && eventful_.push(*undelivered_)) undelivered_.reset();
  return !undelivered_;
}

/// What stands still must not push: a force that was right a moment ago is not while the hand moves
/// on without the simulation.
void SimulationLoop::ask_for_no_force() noexcept {
  for (simulation::HandView& hand : state_.snapshot.hands) hand.force_in_patient = {};
}

bool SimulationLoop::tick() noexcept {
  if (!has_delivered()) return false;
  session::HeldInput newest;
  if (held_.take(newest)) source_.hold(newest);
  if (!next_command_) next_command_ = commands_.pop();
  const simulation::Command command = next_command_.value_or(simulation::Command{});
  simulation::Input input = source_.input(command);
  if (guest_ != nullptr) guest_->before(input, state_.snapshot);
  // The input is on its way to the recording before it is used: what cannot be recorded does not
  // happen.
  if (!inputs_.push(input)) return false;
  next_command_.reset();
  source_.passed();
  state_.snapshot = step_(input);
  if (guest_ != nullptr) guest_->after(state_.snapshot);
  if (state_.snapshot.event_count > 0 || command.kind != simulation::CommandKind::None) {
    undelivered_ = EventfulTick{command, state_.snapshot};
    (void)has_delivered();
  }
  return true;
}

}  // namespace carpus::server
