// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Our arm with either drive: a host that ticks at 1 kHz, real frames over a line that can be bad,
// firmware, plant.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "core/rng.hpp"
#include "device_bench/rig.hpp"
#include "firmware/core/frame_decoder.hpp"
#include "haptics/leg_stops.hpp"
#include "haptics/passivity_net.hpp"

namespace carpus::device_bench {

class OurRig final : public Rig {
 public:
  explicit OurRig(const RigOptions& options);

  [[nodiscard]] virtual_arm::ArmPlant& plant() override { return arm_->plant(); }
  void run_ms() override;
  [[nodiscard]] double quantum_mm() const override;
  [[nodiscard]] bool is_driven() const override { return arm_->is_driven(); }

  [[nodiscard]] virtual_arm::VirtualArm& arm() { return *arm_; }
  [[nodiscard]] std::uint8_t status() const { return status_; }
  [[nodiscard]] bool is_running() const { return is_running_; }
  /// From a frame's first byte to its answer's last, of every answer since the start [us].
  [[nodiscard]] const std::vector<double>& round_trips_us() const { return round_trips_us_; }
  /// Age of the newest sample when its answer left [us]; drive A.
  [[nodiscard]] const std::vector<double>& sample_ages_us() const { return sample_ages_us_; }
  [[nodiscard]] int net_catches() const { return net_.catches(); }
  /// Besides what the wall does: to time how long a command takes to be felt [N]; drive B.
  Vec3 besides_n;

 private:
  void hear(std::uint8_t byte, double us);
  void estimate(const std::array<double, 3>& angles);
  void tick();
  void send_wish();
  template <typename Frame>
  void send(const Frame& frame);
  void put_on_line(std::vector<std::uint8_t> bytes);
  [[nodiscard]] Vec3 weight_n() const;

  std::unique_ptr<virtual_arm::VirtualArm> arm_;
  firmware::HostDecoder decoder_;
  haptics::LegStops stops_;
  haptics::PassivityNet net_;
  haptics::ForceLimiter limiter_{8};
  Rng line_rng_;
  std::array<arm::LegCalibration, 3> calibrations_;
  std::array<double, 256> sent_us_{};
  std::vector<double> round_trips_us_;
  std::vector<double> sample_ages_us_;
  std::deque<std::vector<std::uint8_t>> late_;
  std::array<double, 3> angles_{};
  std::array<double, 3> rates_{};
  Vec3 tip_;
  Vec3 velocity_;
  Vec3 last_besides_;
  double share_ = 1;
  double answered_us_ = 0;
  std::uint64_t ticks_ = 0;
  std::uint8_t sequence_ = 0;
  std::uint8_t status_ = 0;
  int next_config_ = 0;
  bool has_angles_ = false;
  bool is_known_ = false;
  bool is_running_ = false;
};

}  // namespace carpus::device_bench
