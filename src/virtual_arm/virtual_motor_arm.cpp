// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive B: gimbal motors and encoders on the delta, the firmware's core at 4 kHz.
#include <array>
#include <cmath>
#include <deque>

#include "core/check.hpp"
#include "firmware/core/motor_arm.hpp"
#include "virtual_arm/gimbal_motor.hpp"
#include "virtual_arm/virtual_arm.hpp"

namespace carpus::virtual_arm {
namespace {

constexpr double kControlUs = 1e6 / firmware::kMotorStepHz;

class VirtualMotorArm final : public VirtualArm {
 public:
  VirtualMotorArm(const VirtualArmOptions& options, const JointValues& angles)
      : unit_(static_cast<std::uint32_t>(options.seed)),
        arm_(unit_),
        linkage_(size_, arm::kMotorArmWeight),
        plant_(linkage_, body_of(arm::kMotorArmWeight, kRotorKgMm2), angles),
        motors_{GimbalMotor{{}, 10 * options.seed + 1}, GimbalMotor{{}, 10 * options.seed + 2},
                GimbalMotor{{}, 10 * options.seed + 3}} {
    plant_.set_hand(options.hand);
  }

  [[nodiscard]] firmware::Drive drive() const override { return firmware::Drive::Motor; }
  [[nodiscard]] ArmPlant& plant() override { return plant_; }
  [[nodiscard]] const arm::DeltaArm& size() const override { return size_; }
  [[nodiscard]] JointValues torques() const override { return torques_; }
  [[nodiscard]] JointValues carrying() override {
    if (!is_driven()) return {};
    JointValues held = plant_.weight_to_hold();
    for (std::size_t i = 0; i < 3; ++i) held[i] *= motors_[i].share_given();
    return held;
  }
  [[nodiscard]] bool is_driven() const override { return arm_.is_driving(); }
  [[nodiscard]] const arm::LegCalibration& leg_calibration(int) const override { return none_; }
  [[nodiscard]] firmware::LegConfig leg_config(int) const override { return {}; }
  [[nodiscard]] firmware::Home home() const override {
    firmware::Home home;
    for (std::size_t i = 0; i < 3; ++i) {
      home.zero_counts[i] = motors_[i].zero_counts();
      home.electrical_zero[i] = motors_[i].windings().electrical_zero;
      home.windings[i] = static_cast<std::uint8_t>(motors_[i].windings().windings);
    }
    return home;
  }
  [[nodiscard]] arm::Cogging cogging() const override {
    arm::Cogging cogging;
    for (std::size_t i = 0; i < 3; ++i) {
      cogging.amplitude_n_mm[i] = motors_[i].measured_cogging_n_mm();
      cogging.phase_rad[i] = motors_[i].measured_phase_rad();
    }
    return cogging;
  }
  void brown_out() override {
    arm_ = firmware::MotorArm(unit_);
    volts_ = {};
    coming_.clear();
    going_.clear();
  }

  void run_to_us(double us) override {
    while (now_us_ + kPlantStepUs <= us) {
      take_line(now_us_ + kPlantStepUs, [this](std::uint8_t byte) {
        coming_.push_back({byte, now_us_ + kByteUs});
      });
      now_us_ += kPlantStepUs;
      serve_line();
      if (now_us_ >= next_control_us_) {
        control();
        next_control_us_ += kControlUs;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        torques_[i] = motors_[i].step(kPlantStepUs * 1e-6, volts_[i], arm_.is_driving(),
                                      plant_.angles()[i], plant_.rates()[i]);
      }
      plant_.step(kPlantStepUs * 1e-6, torques_);
      if (on_step) on_step(kPlantStepUs * 1e-6);
    }
  }

 private:
  struct OnLine {
    std::uint8_t byte = 0;
    double us = 0;
  };

  void control() {
    std::int32_t counts[3];
    for (std::size_t i = 0; i < 3; ++i) {
      counts[i] = motors_[i].counts(plant_.angles()[i]);
      // A magnet that has come loose.
      if (faults.broken_sensor == static_cast<int>(i) && (jumps_ = !jumps_)) counts[i] += 5000;
    }
    float wished[3];
    arm_.sample_roll(
        static_cast<std::uint16_t>(firmware::kRollsOfTurn * share_of_turn(tool_roll_rad)));
    arm_.step(counts, static_cast<std::uint32_t>(now_us_), wished);
    for (std::uint8_t i = 0; i < 3; ++i) volts_[i] = arm_.volts(i);
  }

  void serve_line() {
    while (!coming_.empty() && coming_.front().us <= now_us_) {
      arm_.take(coming_.front().byte, static_cast<std::uint32_t>(now_us_));
      coming_.pop_front();
    }
    std::uint8_t bytes[firmware::kMaxDeviceFrameBytes];
    double at = going_.empty() ? now_us_ : going_.back().us;
    const int length = arm_.reply(bytes, static_cast<std::uint32_t>(now_us_));
    for (int i = 0; i < length; ++i) going_.push_back({bytes[i], at += kByteUs});
    while (!going_.empty() && going_.front().us <= now_us_) {
      const OnLine next = going_.front();
      going_.pop_front();
      if (on_byte) on_byte(next.byte, next.us);
    }
  }

  std::uint32_t unit_;
  firmware::MotorArm arm_;
  arm::DeltaArm size_;
  DeltaLinkage linkage_;
  ArmPlant plant_;
  std::array<GimbalMotor, 3> motors_;
  arm::LegCalibration none_;
  JointValues torques_{};
  std::array<firmware::WindingVolts, 3> volts_{};
  std::deque<OnLine> coming_;
  std::deque<OnLine> going_;
  double next_control_us_ = 0;
  bool jumps_ = false;
};

}  // namespace

std::unique_ptr<VirtualArm> make_virtual_motor_arm(const VirtualArmOptions& options) {
  const auto angles = arm::inverse({}, options.tip);
  CARPUS_CHECK(angles.has_value());
  return std::make_unique<VirtualMotorArm>(options, *angles);
}

}  // namespace carpus::virtual_arm
