// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The devices of a station: which there are, which hand holds which, how each is. A page chooses
// only among those that were found here; a path of its own it cannot name. In the network's thread.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/calibration_desk.hpp"
#include "devices/device_catalogue.hpp"
#include "devices/host_loop.hpp"
#include "protocol/messages.hpp"
#include "server/device_hands.hpp"

namespace carpus::server {

class DeviceDesk {
 public:
  /// @param search  where devices are looked for; none: this station has none.
  explicit DeviceDesk(std::optional<devices::DeviceSearch> search) : search_(std::move(search)) {}

  /// Takes part in each tick of an exercise; lives as long as this.
  [[nodiscard]] TickGuest& guest() noexcept { return hands_; }

  void find();
  /// @throws InvalidInput where no such device was found.
  void use(const protocol::UseDevice& wish);
  /// @throws InvalidInput where the hand holds no device, or time passes.
  void test_wall(const protocol::TestWall& wish, bool time_passes);
  void calibrate(const protocol::Calibrate& wish, bool time_passes);
  /// No wall, no calibration: time passes again, or the page is gone.
  void end_trials();

  /// To be called many times a second. @return the first time that a device which worked does not:
  /// what to tell the trainee.
  [[nodiscard]] std::optional<std::string> look();
  /// Why time should not go on; empty where every hand's device works.
  [[nodiscard]] std::string why_not_go_on() const;
  /// Whether the page wants to be told now.
  [[nodiscard]] bool is_due();
  [[nodiscard]] protocol::Devices message() const;

 private:
  struct Held {
    std::string id;
    std::string name;
    std::unique_ptr<devices::HostLoop> loop;
    devices::LoopState state;
    DeviceView view;
    std::optional<Aim> wished_aim;  ///< none: what it does best
    bool has_worked = false;
    bool is_lost = false;
    bool is_testing = false;
    std::unique_ptr<devices::CalibrationDesk> calibration;
    std::string note;
  };
  static constexpr std::chrono::milliseconds kTellEvery{250};
  /// So long after it was asked for.
  static constexpr std::chrono::seconds kTellFor{10};

  [[nodiscard]] Held& held(std::int64_t hand, bool time_passes);
  [[nodiscard]] static Aim aim_of(const Held& held) noexcept;
  [[nodiscard]] protocol::HandDevice describe(const Held& held) const;

  std::optional<devices::DeviceSearch> search_;
  std::vector<devices::FoundDevice> found_;
  DeviceHands hands_;  ///< before the loops, which use it
  std::array<Held, simulation::kHands> held_;
  std::chrono::steady_clock::time_point asked_at_;
  std::chrono::steady_clock::time_point told_at_;
  bool was_asked_ = false;
};

}  // namespace carpus::server
