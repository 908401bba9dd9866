// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Drive A: potentiometers, slots and hobby servos on the delta.
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "arm/potentiometer.hpp"
#include "core/check.hpp"
#include "core/units.hpp"
#include "virtual_arm/hobby_servo.hpp"
#include "virtual_arm/slot.hpp"
#include "virtual_arm/virtual_arm.hpp"

namespace carpus::virtual_arm {
namespace {

constexpr double kRadPerUnit = kPi / 8192;
/// The middle of a leg's travel, where potentiometer and servo stand in the middle of theirs.
constexpr double kMiddleRad = 0.1775;
/// Between the motor and its horn: 0.6 degrees, which the calibration by touch finds with the gap.
constexpr double kBacklashRad = 0.0052;

class VirtualStopArm final : public VirtualArm {
 public:
  VirtualStopArm(const VirtualArmOptions& options,
                 std::unique_ptr<StopBoard> board,
                 const JointValues& angles)
      : linkage_(size_, arm::kStopArmWeight),
        plant_(linkage_, body_of(arm::kStopArmWeight), angles),
        board_(std::move(board)),
        pots_{arm::Potentiometer{{}, 10 * options.seed + 1},
              arm::Potentiometer{{}, 10 * options.seed + 2},
              arm::Potentiometer{{}, 10 * options.seed + 3}},
        servos_{HobbyServo{{}, 10 * options.seed + 4}, HobbyServo{{}, 10 * options.seed + 5},
                HobbyServo{{}, 10 * options.seed + 6}} {
    slot_.gap_rad += 0.5 * kBacklashRad;
    plant_.set_hand(options.hand);
    for (std::size_t leg = 0; leg < 3; ++leg) {
      calibrate(leg);
      servos_[leg].put(angles[leg] - kMiddleRad);
      pulse_error_us_[leg] = Rng(10 * options.seed + 7 + leg).uniform(-1.5, 1.5);
    }
    board_->on_byte = [this](std::uint8_t byte, double us) {
      if (on_byte) on_byte(byte, us);
    };
    board_->on_pulse = [this](int leg, double begun_us, double length_us) {
      servos_[static_cast<std::size_t>(leg)].pulse(length_us, begun_us + length_us);
    };
  }

  [[nodiscard]] firmware::Drive drive() const override { return firmware::Drive::Stop; }
  [[nodiscard]] ArmPlant& plant() override { return plant_; }
  [[nodiscard]] const arm::DeltaArm& size() const override { return size_; }
  [[nodiscard]] JointValues torques() const override { return torques_; }
  [[nodiscard]] bool is_driven() const override { return board_->is_supply_on(); }
  [[nodiscard]] const arm::LegCalibration& leg_calibration(int leg) const override {
    return calibrations_[static_cast<std::size_t>(leg)];
  }
  [[nodiscard]] firmware::Home home() const override { return {}; }
  void brown_out() override { board_->brown_out(); }

  [[nodiscard]] firmware::LegConfig leg_config(int leg) const override {
    const auto i = static_cast<std::size_t>(leg);
    firmware::LegConfig config;
    config.leg = static_cast<std::uint8_t>(leg);
    arm::put_line(calibrations_[i], config);
    // Found by turning the horn until the leg moves to either side: a little wrong.
    config.pulse_at_zero_us = static_cast<std::uint16_t>(
        std::lround(servos_[i].pulse_for(-kMiddleRad) + pulse_error_us_[i]));
    config.pulse_per_turn_us = 1000;
    config.gap = static_cast<std::uint16_t>(std::lround(slot_.gap_rad / kRadPerUnit));
    config.least_pulse_us = 1000;
    config.most_pulse_us = 2000;
    return config;
  }

  void run_to_us(double us) override {
    while (now_us_ + kPlantStepUs <= us) {
      take_line(now_us_ + kPlantStepUs, [this](std::uint8_t byte) { board_->receive(byte); });
      for (int leg = 0; leg < 3; ++leg) {
        const auto i = static_cast<std::size_t>(leg);
        board_->set_wiper(leg, faults.broken_sensor == leg
                                   ? 1.0
                                   : pots_[i].read(plant_.angles()[i] - kMiddleRad));
      }
      board_->set_roll(share_of_turn(tool_roll_rad));
      now_us_ += kPlantStepUs;
      board_->run_to_us(now_us_);
      move(kPlantStepUs * 1e-6);
      if (on_step) on_step(kPlantStepUs * 1e-6);
    }
  }

 private:
  void move(double seconds) {
    for (std::size_t i = 0; i < 3; ++i) {
      HobbyServo& servo = servos_[i];
      servo.set_supply(board_->is_supply_on());
      torques_[i] = slot_.torque(plant_.angles()[i], servo.horn_rad() + kMiddleRad,
                                 plant_.rates()[i], servo.rate_rad_per_s());
      servo.step(seconds, now_us_, -torques_[i]);
    }
    plant_.step(seconds, torques_);
  }

  /// As with the gauge: thirteen notches, 64 samples in each.
  void calibrate(std::size_t leg) {
    constexpr int kNotches = 13;
    constexpr int kSamples = 64;
    std::vector<arm::CalibrationPoint> points;
    for (int i = 0; i < kNotches; ++i) {
      arm::CalibrationPoint point;
      point.angle_rad =
          size_.least_angle + (size_.most_angle - size_.least_angle) * i / (kNotches - 1);
      for (int k = 0; k < kSamples; ++k) {
        point.counts +=
            4.0 * arm::counts_of(pots_[leg].read(point.angle_rad - kMiddleRad), 10) / kSamples;
      }
      points.push_back(point);
    }
    const auto calibration = arm::calibrate_leg(points);
    CARPUS_CHECK(calibration.has_value());
    calibrations_[leg] = *calibration;
  }

  arm::DeltaArm size_;
  DeltaLinkage linkage_;
  ArmPlant plant_;
  std::unique_ptr<StopBoard> board_;
  std::array<arm::Potentiometer, 3> pots_;
  std::array<HobbyServo, 3> servos_;
  std::array<arm::LegCalibration, 3> calibrations_;
  std::array<double, 3> pulse_error_us_{};
  Slot slot_;
  JointValues torques_{};
};

}  // namespace

std::unique_ptr<VirtualArm> make_virtual_stop_arm(const VirtualArmOptions& options,
                                                  std::unique_ptr<StopBoard> board) {
  const auto angles = arm::inverse({}, options.tip);
  CARPUS_CHECK(angles.has_value());
  if (!board) board = std::make_unique<CoreStopBoard>(static_cast<std::uint32_t>(options.seed));
  return std::make_unique<VirtualStopArm>(options, std::move(board), *angles);
}

}  // namespace carpus::virtual_arm
