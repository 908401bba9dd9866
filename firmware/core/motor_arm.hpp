// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole firmware of an arm with drive B but for its pins: bytes and encoder counts in, voltages
// of windings and bytes out. A board calls take() for each byte, step() at kMotorStepHz, then
// volts() for each motor, reply() when the line is free.
#pragma once

#include "firmware/core/delta.hpp"
#include "firmware/core/frame_decoder.hpp"
#include "firmware/core/gimbal_commutation.hpp"
#include "firmware/core/motor_alignment.hpp"
#include "firmware/core/motor_limits.hpp"
#include "firmware/core/plane_renderer.hpp"
#include "firmware/core/stop_arm.hpp"
#include "firmware/core/tool_roll.hpp"
#include "firmware/core/watchdog.hpp"

namespace carpus {
namespace firmware {

constexpr uint16_t kMotorStepHz = 4000;
/// 14 bits on the motor, ten turns of it to one of the leg.
constexpr float kRadPerCount = 6.28318531F / (16384.0F * 10.0F);
/// 150 Hz on the legs' rates: at 20 Hz a wall of 5 N/mm rings already, above 150 Hz noise is felt.
constexpr float kRateFilter = 0.19F;
/// 440 Hz on those by which what the motors induce is added: there noise is not felt, but a lag is,
/// as mass.
constexpr float kInducedFilter = 0.5F;
/// Force fades over the last ten milliseconds of a silence that the watchdog ends.
constexpr uint32_t kFadeUs = 10000;
/// Torque comes up over so many steps after it was taken away: 50 ms.
constexpr uint16_t kSoftStartSteps = kMotorStepHz / 20;
/// No leg turns faster: 120 rad/s, in counts of a step.
constexpr int32_t kMostCountStep = 782;

inline uint8_t motor_arm_payload_bytes(uint8_t kind) {
  return kind == kind_of(Stop{}) || kind == kind_of(LegConfig{})
             ? uint8_t{255}
             : host_to_device_payload_bytes(kind);
}

class MotorArm {
 public:
  explicit MotorArm(uint32_t unit,
                    const MotorLimits& limits = MotorLimits(),
                    const DeltaSize<float>& size = DeltaSize<float>())
      : limits_(limits), heat_(limits), size_(size), unit_(unit) {}

  void take(uint8_t byte, uint32_t now_us) {
    decoder_.push(byte);
    while (decoder_.next()) act(now_us);
  }

  /// @param counts  of the three motors' encoders @param torques  of the legs [N mm].
  void step(const int32_t* counts, uint32_t now_us, float* torques) {
    constexpr float kStep = 1.0F / kMotorStepHz;
    torques[0] = torques[1] = torques[2] = 0.0F;
    sampled_us_ = now_us;
    watchdog_.tick(now_us);
    read_sensors(counts);
    status_limited_ = false;
    const bool may_drive = is_homed_ && is_asked_ && !after_reset_ && watchdog_.may_drive() &&
                           !has_fault() && state_.is_valid && !is_too_fast_;
    if (!may_drive) {
      if (watchdog_.is_silent()) is_asked_ = false;
      renderer_.forget();
      soft_start_ = 0;
      force_ = Vector<float>();
    } else {
      force_ = renderer_.step(state_.tip, velocity_);
      if (soft_start_ < kSoftStartSteps) ++soft_start_;
      force_ = force_ * (static_cast<float>(soft_start_) / kSoftStartSteps) * fade(now_us);
      delta_torques(state_, force_, torques);
      status_limited_ = limit_torques(limits_, heat_.share(), torques);
    }
    align(counts, torques);
    heat_.step(torques, kStep);
    for (uint8_t i = 0; i < 3; ++i) torques_[i] = torques[i];
    if (alignment_.is_running()) torques[0] = torques[1] = torques[2] = 0.0F;
  }

  /// The tool's turn, as its sensor says it last [1/4096 turn].
  void sample_roll(uint16_t roll) { roll_ = roll < kRollsOfTurn ? roll : 0; }

  /// Whether its motors are to have their supply, and their drivers be on.
  bool is_driving() const { return soft_start_ > 0 || alignment_.is_running(); }
  /// Of a motor's windings, until the next step.
  WindingVolts volts(uint8_t motor) const {
    if (alignment_.is_running()) return motor == aligned_ ? alignment_.volts() : WindingVolts();
    if (soft_start_ == 0) return WindingVolts();
    return commutate(GimbalWindings(), windings_[motor], counts_[motor], torques_[motor],
                     quick_rates_[motor]);
  }

  uint8_t reply(uint8_t* to, uint32_t now_us) {
    (void)now_us;
    const Answer due = due_;
    due_ = Answer::None;
    if (due == Answer::None) return 0;
    if (due == Answer::Identity) {
      Identity identity;
      identity.version = kProtocolVersion;
      identity.drive = static_cast<uint8_t>(Drive::Motor);
      identity.firmware = kFirmwareRevision;
      identity.unit = unit_;
      return encode_frame(identity, sequence_++, to);
    }
    if (due == Answer::Alignment) return reply_alignment(to);
    Motion motion;
    motion.echo = watchdog_.sequence();
    motion.status = status();
    motion.time_us = sampled_us_;
    for (uint8_t i = 0; i < 3; ++i) motion.counts[i] = counts_[i];
    motion.force_mn[0] = static_cast<int16_t>(force_.x * 1000.0F);
    motion.force_mn[1] = static_cast<int16_t>(force_.y * 1000.0F);
    motion.force_mn[2] = static_cast<int16_t>(force_.z * 1000.0F);
    motion.hottest_c = static_cast<uint8_t>(clamped(heat_.hottest_c(), 0.0F, 255.0F));
    motion.roll = roll_;
    return encode_frame(motion, sequence_++, to);
  }

  uint8_t status() const {
    unsigned status = 0;
    if (is_homed_) status |= kStatusConfigured;
    if (is_driving()) status |= kStatusDriving;
    if (watchdog_.is_silent()) status |= kStatusSilent;
    if (has_fault()) status |= kStatusSensorFault;
    if (status_limited_) status |= kStatusLimited;
    if (heat_.share() < 1.0F) status |= kStatusHot;
    if (after_reset_) status |= kStatusAfterReset;
    if (is_too_fast_) status |= kStatusTooFast;
    return static_cast<uint8_t>(status);
  }
  const DeltaState<float>& state() const { return state_; }
  Vector<float> force() const { return force_; }
  uint32_t scaled() const { return renderer_.scaled(); }

 private:
  enum class Answer : uint8_t { None, Identity, Motion, Alignment };
  using Decoder = FrameDecoder<motor_arm_payload_bytes, kMaxFrameBytes>;

  void act(uint32_t now_us) {
    if (decoder_.kind() == kind_of(Hello{})) {
      watchdog_.forget();
      is_asked_ = false;
      is_alignment_asked_ = false;
      alignment_.forget();
      after_reset_ = false;
      due_ = Answer::Identity;
      return;
    }
    Release release;
    Contact contact;
    Home home;
    Align align;
    const bool is_align = decoder_.read_frame(align);
    const bool is_release = decoder_.read_frame(release);
    const bool is_contact = decoder_.read_frame(contact);
    const bool is_home = decoder_.read_frame(home);
    if (!is_release && !is_contact && !is_home && !is_align) return;
    if (!watchdog_.heard(decoder_.sequence(), now_us)) return;
    due_ = is_align ? Answer::Alignment : Answer::Motion;
    if (!is_align) {
      alignment_.forget();
      is_alignment_asked_ = false;
    }
    if (is_align) {
      is_asked_ = false;
      is_alignment_asked_ = true;
    } else if (is_contact) {
      renderer_.take(contact);
      is_asked_ = true;
    } else if (is_release) {
      is_asked_ = false;
    } else if (soft_start_ == 0) {
      is_homed_ = true;
      for (uint8_t i = 0; i < 3; ++i) {
        zero_[i] = home.zero_counts[i];
        windings_[i].electrical_zero = home.electrical_zero[i];
        windings_[i].windings = static_cast<Windings>(home.windings[i]);
        if (windings_[i].windings == Windings::Unknown) is_homed_ = false;
      }
      has_counts_ = false;
    }
  }

  /// A hand that holds on is pulled by 5 N; a motor that runs away is not followed.
  void align(const int32_t* counts, float* torques) {
    if (watchdog_.is_silent() || !watchdog_.may_drive()) {
      if (watchdog_.is_silent()) is_alignment_asked_ = false;
      if (alignment_.is_running()) alignment_.forget();
      return;
    }
    if (!is_alignment_asked_ || soft_start_ > 0 || after_reset_) return;
    if (has_fault() || heat_.share() < 1.0F) {
      alignment_.forget();
      return;
    }
    if (alignment_.progress() == Progress::Waiting) alignment_.start();
    if (!alignment_.is_running()) return;
    aligned_ = alignment_.step(counts);
    constexpr float kTorque =
        MotorAlignment::kVolts / GimbalWindings().ohm * GimbalWindings().torque_per_amp;
    torques[aligned_] = kTorque;  // heats the windings
  }

  uint8_t reply_alignment(uint8_t* to) {
    Alignment alignment;
    alignment.echo = watchdog_.sequence();
    alignment.status = status();
    alignment.progress = static_cast<uint8_t>(alignment_.progress());
    for (uint8_t i = 0; i < 3; ++i) {
      alignment.electrical_zero[i] = alignment_.found(i).electrical_zero;
      alignment.windings_found[i] = static_cast<uint8_t>(alignment_.found(i).windings);
    }
    return encode_frame(alignment, sequence_++, to);
  }

  void read_sensors(const int32_t* counts) {
    float rates[3];
    float angles[3];
    bool is_jump = false;
    for (uint8_t i = 0; i < 3; ++i) {
      const int32_t step = has_counts_ ? counts[i] - counts_[i] : 0;
      if (step > kMostCountStep || step < -kMostCountStep) is_jump = true;
      counts_[i] = counts[i];
      const float rate = static_cast<float>(step) * (kRadPerCount * kMotorStepHz);
      rates_[i] += (rate - rates_[i]) * kRateFilter;
      quick_rates_[i] += (rate - quick_rates_[i]) * kInducedFilter;
      rates[i] = rates_[i];
      angles[i] = static_cast<float>(counts[i] - zero_[i]) * kRadPerCount;
    }
    has_counts_ = true;
    if (is_jump) {
      good_steps_ = 0;
    } else if (good_steps_ < kTrustSteps) {
      ++good_steps_;
    }
    state_ = delta_forward(size_, angles);
    velocity_ = state_.is_valid ? delta_velocity(state_, rates) : Vector<float>();
    // Once too fast, until it has nearly come to rest.
    const float speed = length(velocity_);
    if (speed > limits_.most_speed) is_too_fast_ = true;
    if (speed < 0.1F * limits_.most_speed) is_too_fast_ = false;
  }

  bool has_fault() const { return good_steps_ < kTrustSteps; }
  float fade(uint32_t now_us) const {
    const uint32_t left = kSilenceUs - watchdog_.silence_us(now_us);
    return left < kFadeUs ? static_cast<float>(left) / kFadeUs : 1.0F;
  }

  /// 40 ms without a jump until the encoders are believed.
  static constexpr uint16_t kTrustSteps = kMotorStepHz / 25;

  Decoder decoder_;
  Watchdog watchdog_;
  MotorLimits limits_;
  ThermalModel heat_;
  DeltaSize<float> size_;
  PlaneRenderer renderer_{1.0F / kMotorStepHz};
  DeltaState<float> state_;
  Vector<float> velocity_;
  Vector<float> force_;
  float rates_[3] = {0.0F, 0.0F, 0.0F};
  float quick_rates_[3] = {0.0F, 0.0F, 0.0F};
  int32_t counts_[3] = {0, 0, 0};
  int32_t zero_[3] = {0, 0, 0};
  WindingsOf windings_[3];
  MotorAlignment alignment_;
  float torques_[3] = {0.0F, 0.0F, 0.0F};
  uint32_t unit_;
  uint32_t sampled_us_ = 0;
  uint16_t soft_start_ = 0;
  uint16_t good_steps_ = 0;
  uint16_t roll_ = 0;
  uint8_t aligned_ = 0;
  uint8_t sequence_ = 0;
  Answer due_ = Answer::None;
  bool has_counts_ = false;
  bool is_homed_ = false;
  bool is_asked_ = false;
  bool is_alignment_asked_ = false;
  bool is_too_fast_ = false;
  bool status_limited_ = false;
  bool after_reset_ = true;
};

}  // namespace firmware
}  // namespace carpus
