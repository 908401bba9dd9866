// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "device_bench/thesis_rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "arm/potentiometer.hpp"
#include "core/check.hpp"
#include "device_bench/collision_question.hpp"
#include "firmware/core/motor_arm.hpp"
#include "virtual_arm/gimbal_motor.hpp"
#include "virtual_arm/hobby_servo.hpp"
#include "virtual_arm/slot.hpp"

namespace carpus::device_bench {
namespace {

using virtual_arm::ArmBody;
using virtual_arm::ArmPlant;
using virtual_arm::GimbalMotor;
using virtual_arm::HobbyServo;
using virtual_arm::JointValues;
using virtual_arm::Slot;

constexpr double kStepUs = virtual_arm::kPlantStepUs;
constexpr double kFrameUs = 1000 * arm::kServoFrameMs;
constexpr double kMostForceN = 8;

/// What both have: a frame of 20 ms, the program's answer, where it first was yes.
class ThesisRig : public Rig {
 public:
  using Rig::Rig;
  void run_ms() override {
    for (int i = 0; i < static_cast<int>(1000 / kStepUs); ++i) {
      now_us_ += kStepUs;
      if (now_us_ >= next_frame_us_) {
        next_frame_us_ += kFrameUs;
        frame();
      }
      move(kStepUs * 1e-6);
    }
  }
  [[nodiscard]] bool is_driven() const override { return is_on_; }

 protected:
  virtual void frame() = 0;
  virtual void move(double seconds) = 0;
  /// @return whether the collision is new.
  bool ask(const Vec3& tip) {
    if (!question_) question_.emplace(wall(), start());
    const bool meets = has_wall() && question_->meets(tip);
    const bool is_new = meets && !is_on_;
    is_on_ = meets;
    return is_new;
  }
  double now_us_ = 0;
  bool is_on_ = false;

 private:
  std::optional<CollisionQuestion> question_;
  double next_frame_us_ = kFrameUs;
};

/// The middle of what it reaches.
constexpr Vec3 kSerialCentre{140, 0, 0};

ArmBody serial_body() {
  ArmBody body;
  body.joint_inertia_kg_mm2 = 600;  // a servo of 44 g at 120 mm [E]
  body.tip_kg = 0.05;               // its tool, of which the thesis says nothing [E]
  body.balanced_share = 0.9;        // in its favour: of balancing the thesis says nothing
  return body;
}

/// "The motor that is placed at the base ... is bigger enough to handle a high torque and supports
/// all the system": the one that carries the arm, with twice the torque [E].
virtual_arm::ServoKind carrier() {
  virtual_arm::ServoKind kind;
  kind.stall_n_mm *= 2;
  return kind;
}

class SerialThesisRig final : public ThesisRig {
 public:
  explicit SerialThesisRig(const RigOptions& options)
      : ThesisRig(options),
        plant_(linkage_, serial_body(), start_angles()),
        pots_{arm::Potentiometer{{}, 10 * options.seed + 1},
              arm::Potentiometer{{}, 10 * options.seed + 2},
              arm::Potentiometer{{}, 10 * options.seed + 3}},
        servos_{HobbyServo{{}, 10 * options.seed + 4}, HobbyServo{carrier(), 10 * options.seed + 5},
                HobbyServo{{}, 10 * options.seed + 6}} {
    set_start(kSerialCentre);
    plant_.set_hand(options.hand);
    rigid_.gap_rad = 0;
    for (std::size_t i = 0; i < 3; ++i) servos_[i].put(plant_.angles()[i]);
  }
  [[nodiscard]] ArmPlant& plant() override { return plant_; }
  [[nodiscard]] double quantum_mm() const override { return 5.93 / 4095 * 140; }

 private:
  [[nodiscard]] JointValues start_angles() const {
    JointValues angles{};
    CARPUS_CHECK(linkage_.inverse(kSerialCentre, angles));
    return angles;
  }

  void frame() override {
    // Three channels of the card, 10 us each, at the potentiometers' nominal travel; each sensor
    // was put in the middle of its travel when the arm was mounted.
    JointValues measured{};
    const JointValues middle = start_angles();
    for (std::size_t i = 0; i < 3; ++i) {
      const double volts = 5 * pots_[i].read(plant_.angles()[i] - middle[i]);
      const double share =
          arm::card_volts(arm::card_counts(volts, arm::CardRange::To5V), arm::CardRange::To5V) / 5;
      measured[i] =
          middle[i] + (share - pots_[i].share_at(0)) * arm::PotentiometerKind{}.travel_rad;
    }
    const bool is_new = ask(linkage_.at(measured).tip);
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_new) hold_[i] = servos_[i].pulse_for(plant_.angles()[i]);
      servos_[i].set_supply(is_on_);
      if (is_on_) servos_[i].pulse(hold_[i], now_us_);
    }
  }

  void move(double seconds) override {
    JointValues torques{};
    for (std::size_t i = 0; i < 3; ++i) {
      HobbyServo& servo = servos_[i];
      torques[i] = rigid_.torque(plant_.angles()[i], servo.horn_rad(), plant_.rates()[i],
                                 servo.rate_rad_per_s());
      servo.step(seconds, now_us_, -torques[i]);
    }
    plant_.step(seconds, torques);
    book(seconds, torques, {});
  }

  virtual_arm::SerialLinkage linkage_;
  ArmPlant plant_;
  std::array<arm::Potentiometer, 3> pots_;
  std::array<HobbyServo, 3> servos_;
  std::array<double, 3> hold_{};
  Slot rigid_;
};

class MotorThesisRig final : public ThesisRig {
 public:
  explicit MotorThesisRig(const RigOptions& options)
      : ThesisRig(options),
        linkage_(size_, arm::kMotorArmWeight),
        plant_(linkage_,
               virtual_arm::body_of(arm::kMotorArmWeight, virtual_arm::kRotorKgMm2),
               *arm::inverse(size_, size_.centre)),
        motors_{GimbalMotor{{}, 10 * options.seed + 1}, GimbalMotor{{}, 10 * options.seed + 2},
                GimbalMotor{{}, 10 * options.seed + 3}} {
    plant_.set_hand(options.hand);
  }
  [[nodiscard]] ArmPlant& plant() override { return plant_; }
  [[nodiscard]] double quantum_mm() const override { return 3.8e-5 * 105; }

 private:
  void frame() override {
    JointValues angles{};
    for (std::size_t i = 0; i < 3; ++i) {
      angles[i] = (motors_[i].counts(plant_.angles()[i]) - motors_[i].zero_counts()) *
                  static_cast<double>(firmware::kRadPerCount);
    }
    const auto state = linkage_.at(angles);
    if (ask(state.tip)) hold_ = state.tip;
    wished_ = {};
    if (!is_on_) return;
    Vec3 force = (hold_ - state.tip) * options().stiffness_n_per_mm;
    const double size = length(force);
    if (size > kMostForceN) force *= kMostForceN / size;
    wished_ = torques_of(state, force);
  }

  /// What the law wishes stands for its 20 ms; the windings are served as by our firmware.
  void move(double seconds) override {
    JointValues torques{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = plant_.angles()[i];
      const double rate = plant_.rates()[i];
      const firmware::WindingVolts volts =
          firmware::commutate({}, motors_[i].windings(), motors_[i].counts(angle),
                              static_cast<float>(wished_[i]), static_cast<float>(rate));
      torques[i] = motors_[i].step(seconds, volts, is_on_, angle, rate);
    }
    plant_.step(seconds, torques);
    book(seconds, torques, {});
  }

  arm::DeltaArm size_;
  virtual_arm::DeltaLinkage linkage_;
  ArmPlant plant_;
  std::array<GimbalMotor, 3> motors_;
  JointValues wished_{};
  Vec3 hold_;
};

}  // namespace

std::unique_ptr<Rig> make_thesis_rig(const RigOptions& options) {
  if (options.drive == firmware::Drive::Motor) return std::make_unique<MotorThesisRig>(options);
  return std::make_unique<SerialThesisRig>(options);
}

}  // namespace carpus::device_bench
