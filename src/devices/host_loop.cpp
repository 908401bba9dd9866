// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/host_loop.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "devices/trusted_command.hpp"
#include "devices/trusted_state.hpp"

namespace carpus::devices {
namespace {

/// Above the simulation's thread (20): a device must be told "nothing" when that one stalls.
constexpr int kRealTimePriority = 30;
constexpr Nanoseconds kSecondNs = 1'000'000'000;
}  // namespace

HostLoop::HostLoop(std::unique_ptr<Device> device, DeviceExchange* exchange)
    : device_(std::move(device)), exchange_(exchange != nullptr ? *exchange : own_) {
  state_.able = device_->capabilities();
  thread_ = std::thread([this] { run(); });
}

HostLoop::~HostLoop() {
  stopping_.store(true, std::memory_order_relaxed);
  thread_.join();
}

std::string HostLoop::problem() const {
  const std::scoped_lock lock(problem_guard_);
  return problem_;
}

void HostLoop::say(const std::string& problem) {
  const std::scoped_lock lock(problem_guard_);
  problem_ = problem;
}

void HostLoop::run() {
  ::pthread_setname_np(::pthread_self(), "carpus device");
  state_.timing.memory_locked = ::mlockall(MCL_CURRENT) == 0;
  state_.timing.fine_timer = ::prctl(PR_SET_TIMERSLACK, 1) == 0;
  sched_param parameters{};
  parameters.sched_priority = kRealTimePriority;
  state_.timing.scheduling = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0
                                 ? SchedulingClass::Fifo
                                 : SchedulingClass::Other;
  while (!stopping_.load(std::memory_order_relaxed)) {
    try {
      device_->open();
      say("");
      work_until_gone();
    } catch (const std::exception& error) {
      say(error.what());
      state_.device = {};
      state_.device.health = Health::Gone;
      state_.able = device_->capabilities();
      publish();
    }
    device_->close();
    const bool is_asked = reopening_.exchange(false, std::memory_order_relaxed);
    if (!is_asked && !stopping_.load(std::memory_order_relaxed)) rest(kTryAgainMs);
  }
}

void HostLoop::rest(std::int64_t ms) const {
  constexpr std::int64_t kStepMs = 20;
  for (std::int64_t rested = 0; rested < ms; rested += kStepMs) {
    if (stopping_.load(std::memory_order_relaxed)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(kStepMs));
  }
}

bool HostLoop::turn(Device& device,
                    Nanoseconds now,
                    const TimedCommand& wish,
                    LoopState& state) noexcept {
  DeviceState read;
  device.poll(now, read);
  if (is_sound(read)) {
    state.device = read;
  } else {
    state.device.health = Health::Faulty;
    ++state.device.refused;
  }
  const bool is_new = now - wish.at_ns <= HostLoop::kWishLastsNs && wish.at_ns <= now + kNsPerMs;
  if (!is_new) ++state.stale;
  const bool may_push = is_new && is_usable(state.device.health);
  const DeviceCommand command =
      may_push ? trusted(wish.command, state.able, state.faults) : DeviceCommand{};
  state.asked_force_n = force_of(command, state.device.position_mm, state.device.velocity_mm_s);
  device.command(now, command);
  return state.device.health != Health::Gone;
}

void HostLoop::work_until_gone() noexcept {
  PreciseClock clock;
  clock.start();
  late_.clear();
  round_trips_.clear();
  second_began_ns_ = monotonic_now();
  worked_ns_ = 0;
  ticks_before_ = state_.timing.ticks;
  state_.able = device_->capabilities();
  bool is_there = true;
  while (is_there && !stopping_.load(std::memory_order_relaxed) &&
         !reopening_.load(std::memory_order_relaxed)) {
    late_.add(static_cast<double>(clock.wait(state_.timing.missed)) / 1000.0);
    const Nanoseconds began = monotonic_now();
    (void)exchange_.wishes.take(wish_);
    if (testing_.load(std::memory_order_relaxed)) {
      put_test_wall(began);
    } else {
      has_wall_ = false;
    }
    const std::uint64_t samples = state_.device.samples;
    const std::uint64_t raw_samples = state_.device.raw_samples;
    const Health before = state_.device.health;
    const bool had_unit = state_.device.has_unit;
    device_->turn_servos(pulse_us_.load(std::memory_order_relaxed));
    is_there = turn(*device_, began, wish_, state_);
    // A driver knows what its device is able to do once that has said who it is.
    if (state_.device.health != before || state_.device.has_unit != had_unit) {
      state_.able = device_->capabilities();
    }
    if (state_.device.samples != samples && state_.device.round_trip_us > 0) {
      round_trips_.add(state_.device.round_trip_us);
    }
    if (state_.device.raw_samples != raw_samples) (void)raw_.push(state_.device.raw_counts);
    ++state_.timing.ticks;
    const Nanoseconds ended = monotonic_now();
    worked_ns_ += ended - began;
    if (ended - second_began_ns_ >= kSecondNs) close_second(ended);
    publish();
  }
}

void HostLoop::put_test_wall(Nanoseconds now) noexcept {
  wish_ = {};
  if (!is_usable(state_.device.health) || !state_.able.absolute) {
    has_wall_ = false;
    return;
  }
  if (!has_wall_) wall_mm_ = state_.device.position_mm.z - kTestWallMm;
  has_wall_ = true;
  wish_.at_ns = now;
  wish_.command.plane_count = 1;
  wish_.command.planes[0] = {{0, 0, 1}, wall_mm_, kTestWallNPerMm, 0.002 * kTestWallNPerMm, 0.2};
  wish_.command.limit_n = kTestLimitN;
}

void HostLoop::close_second(Nanoseconds now) noexcept {
  LoopTiming& timing = state_.timing;
  const auto passed = static_cast<double>(now - second_began_ns_);
  timing.rate_hz = static_cast<double>(timing.ticks - ticks_before_) * 1e9 / passed;
  timing.late_p50_us = late_.quantile(0.5);
  timing.late_p99_us = late_.quantile(0.99);
  timing.late_p999_us = late_.quantile(0.999);
  timing.late_worst_us = late_.most();
  timing.round_trip_p50_us = round_trips_.quantile(0.5);
  timing.round_trip_p99_us = round_trips_.quantile(0.99);
  timing.work_share = static_cast<double>(worked_ns_) / passed;
  late_.clear();
  round_trips_.clear();
  second_began_ns_ = now;
  worked_ns_ = 0;
  ticks_before_ = timing.ticks;
}

void HostLoop::publish() noexcept {
  exchange_.states.publish(state_);
  looks_.publish(state_);
}

}  // namespace carpus::devices
