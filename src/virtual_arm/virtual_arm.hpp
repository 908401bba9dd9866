// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Our arm without an arm: bytes in, bytes out, as on its serial line, with the firmware, one
// specimen of every part, and a hand that moves it, on a clock that the caller moves. The same
// bytes and places in every run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "arm/cogging.hpp"
#include "arm/delta_arm.hpp"
#include "arm/leg_calibration.hpp"
#include "firmware/core/wire.hpp"
#include "virtual_arm/arm_plant.hpp"
#include "virtual_arm/stop_board.hpp"

namespace carpus::virtual_arm {

/// What is wrong with it, to try what firmware and host then do.
struct ArmFaults {
  /// This leg's sensor is at its rail (drive A), or jumps (drive B); -1: none.
  int broken_sensor = -1;
};

class VirtualArm {
 public:
  VirtualArm() = default;
  VirtualArm(const VirtualArm&) = delete;
  VirtualArm& operator=(const VirtualArm&) = delete;
  virtual ~VirtualArm() = default;

  [[nodiscard]] virtual firmware::Drive drive() const = 0;
  /// The bytes follow each other on the line from now on, behind what is still on it.
  void send(std::span<const std::uint8_t> bytes);
  /// Firmware, drives, arm and hand until this time since the start [us].
  virtual void run_to_us(double us) = 0;
  [[nodiscard]] double now_us() const { return now_us_; }
  /// What the device sent, when the byte was whole.
  std::function<void(std::uint8_t byte, double us)> on_byte;
  /// After every step of the plant.
  std::function<void(double seconds)> on_step;

  /// The arm and the hand on it: where the hand means to be is set there.
  [[nodiscard]] virtual ArmPlant& plant() = 0;
  [[nodiscard]] virtual const arm::DeltaArm& size() const = 0;
  /// What the drives do to the joints now [N mm].
  [[nodiscard]] virtual JointValues torques() const = 0;
  /// Of those, what carries the arm's weight while its host runs: drive B's, each by its share.
  [[nodiscard]] virtual JointValues carrying() { return {}; }
  /// Power that the drives can still spend: false once the firmware has taken it away.
  [[nodiscard]] virtual bool is_driven() const = 0;
  /// The host's own frames that make it ready, as a guided calibration would find them: the legs'
  /// lines, or the encoders' zeros. Hello is not among them.
  [[nodiscard]] virtual const arm::LegCalibration& leg_calibration(int leg) const = 0;
  [[nodiscard]] virtual firmware::LegConfig leg_config(int leg) const = 0;
  [[nodiscard]] virtual firmware::Home home() const = 0;
  /// Of drive B's motors, measured as well as a calibration can; drive A has none.
  [[nodiscard]] virtual arm::Cogging cogging() const { return {}; }

  ArmFaults faults;
  /// How the tool is turned in its gimbal, against what its sensor calls 0.
  double tool_roll_rad = 0;
  /// The supply fails, and comes back.
  virtual void brown_out() = 0;

 protected:
  /// The line's bytes that begin before `us`. Calls `begin` for each when its time has come.
  void take_line(double us, const std::function<void(std::uint8_t)>& begin);
  double now_us_ = 0;

 private:
  struct Waiting {
    std::uint8_t byte = 0;
    double us = 0;
  };
  std::deque<Waiting> line_;
  double line_free_us_ = 0;
};

/// Of a turn, from 0 to below 1, as a magnet's sensor tells it.
[[nodiscard]] double share_of_turn(double rad) noexcept;

/// Step of the plant [us]; drive B's control of 4 kHz takes ten of them.
inline constexpr double kPlantStepUs = 25;

struct VirtualArmOptions {
  std::uint64_t seed = 1;
  /// Where the tip is at the start, in the device's frame [mm].
  Vec3 tip{0, 0, -130};
  HandModel hand = kHandModels[1];
};

/// @param board  for drive A; null: the core compiled for the host.
[[nodiscard]] std::unique_ptr<VirtualArm> make_virtual_stop_arm(
    const VirtualArmOptions& options,
    std::unique_ptr<StopBoard> board = nullptr);
[[nodiscard]] std::unique_ptr<VirtualArm> make_virtual_motor_arm(const VirtualArmOptions& options);

}  // namespace carpus::virtual_arm
