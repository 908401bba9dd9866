// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One device in a thread of its own at 1 kHz: takes what it says, hands over the newest wish, never
// waits for anybody. A wish that is older than kWishLastsNs is none: while an exercise is paused,
// stalled or gone the loop goes on and asks for nothing. A device that is unplugged is opened again
// when it is back.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/latest_value.hpp"
#include "core/spsc_ring.hpp"
#include "devices/device.hpp"
#include "devices/loop_timing.hpp"
#include "devices/precise_clock.hpp"

namespace carpus::devices {

/// What somebody wishes, and when.
struct TimedCommand {
  DeviceCommand command;
  Nanoseconds at_ns = 0;
};

/// What leaves the loop each turn.
struct LoopState {
  DeviceState device;
  Capabilities able;
  LoopTiming timing;
  Vec3 asked_force_n;        ///< last, by planes and force, after all limits
  std::uint64_t faults = 0;  ///< wishes that were no numbers
  std::uint64_t stale = 0;   ///< turns without a wish that was new enough
};

/// What a loop and whoever steps an exercise tell each other. It outlives both: devices and
/// exercises come and go.
struct DeviceExchange {
  LatestValue<TimedCommand> wishes;
  LatestValue<LoopState> states;
};

class HostLoop {
 public:
  /// Three ticks of the exercise and a frame; the firmware's own watchdog comes after 25 ms.
  static constexpr Nanoseconds kWishLastsNs = 5 * kNsPerMs;
  /// So long between two tries to open a device that is gone.
  static constexpr std::int64_t kTryAgainMs = 300;

  /// Starts the thread; the device is opened in it. @param exchange  null: one of its own.
  explicit HostLoop(std::unique_ptr<Device> device, DeviceExchange* exchange = nullptr);
  ~HostLoop();
  HostLoop(const HostLoop&) = delete;
  HostLoop& operator=(const HostLoop&) = delete;

  /// By one other thread; never waits.
  void wish(const TimedCommand& wish) noexcept { exchange_.wishes.publish(wish); }
  /// For one reader: true when there is something newer than at the last call. Never waits.
  [[nodiscard]] bool take(LoopState& state) noexcept { return exchange_.states.take(state); }
  /// For another reader, whom it does not hurry: the same.
  [[nodiscard]] bool look(LoopState& state) noexcept { return looks_.take(state); }
  /// Each of the sensors' samples, in order, for whoever calibrates; what nobody takes is lost. By
  /// one thread.
  [[nodiscard]] std::optional<std::array<std::int32_t, 3>> next_raw() noexcept {
    return raw_.pop();
  }
  /// A level wall kTestWallMm below where the tip is when this is called, whatever is wished.
  void test_wall(bool on) noexcept { testing_.store(on, std::memory_order_relaxed); }
  static constexpr double kTestWallMm = 5;
  static constexpr double kTestWallNPerMm = 1;
  static constexpr double kTestLimitN = 3;
  /// While it is calibrated: see Device::turn_servos. 0: as usual. By any thread.
  void turn_servos(int pulse_us) noexcept { pulse_us_.store(pulse_us, std::memory_order_relaxed); }
  /// Closes the device and opens it anew: what it reads from files has changed. By any thread.
  void reopen() noexcept { reopening_.store(true, std::memory_order_relaxed); }
  /// Why the device could not be opened at the last try; empty when it was.
  [[nodiscard]] std::string problem() const;

  /// One turn, in the caller's time: for tests of what it does and of what it allocates.
  /// @return false when the device is gone.
  [[nodiscard]] static bool turn(Device& device,
                                 Nanoseconds now,
                                 const TimedCommand& wish,
                                 LoopState& state) noexcept;

 private:
  void run();
  void say(const std::string& problem);
  void work_until_gone() noexcept;
  void close_second(Nanoseconds now) noexcept;
  void publish() noexcept;
  void put_test_wall(Nanoseconds now) noexcept;
  void rest(std::int64_t ms) const;

  std::unique_ptr<Device> device_;
  LoopState state_;
  TimedCommand wish_;
  TimeHistogram late_;
  TimeHistogram round_trips_;
  Nanoseconds second_began_ns_ = 0;
  Nanoseconds worked_ns_ = 0;
  std::uint64_t ticks_before_ = 0;

  DeviceExchange own_;
  DeviceExchange& exchange_;
  LatestValue<LoopState> looks_;
  /// Held where a device is opened and where it is lost, never between: there the loop runs.
  mutable std::mutex problem_guard_;
  std::string problem_;
  SpscRing<std::array<std::int32_t, 3>, 512> raw_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> reopening_{false};
  std::atomic<bool> testing_{false};
  std::atomic<int> pulse_us_{0};
  bool has_wall_ = false;
  double wall_mm_ = 0;
  std::thread thread_;
};

}  // namespace carpus::devices
