// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole firmware of an arm with drive A but for its pins: bytes and samples in, pulses and
// bytes out. A board calls, in one loop: take() for each byte, sample() for each leg's sample,
// step() for a leg at a time, sent() when a pulse has begun, reply() when the line is free.
#pragma once

#include "firmware/core/frame_decoder.hpp"
#include "firmware/core/leg_stop_drive.hpp"
#include "firmware/core/tool_roll.hpp"
#include "firmware/core/watchdog.hpp"

namespace carpus {
namespace firmware {

constexpr uint16_t kFirmwareRevision = 2;

/// Contacts are not for this drive.
inline uint8_t stop_arm_payload_bytes(uint8_t kind) {
  return kind == kind_of(Contact{}) || kind == kind_of(Home{}) || kind == kind_of(Align{})
             ? uint8_t{255}
             : host_to_device_payload_bytes(kind);
}

class StopArm {
 public:
  static constexpr uint8_t kLegs = 3;

  explicit StopArm(uint32_t unit) : unit_(unit) {}

  void take(uint8_t byte, uint32_t now_us) {
    if (push(byte)) act(now_us);
  }
  /// As take(), in two parts: a board asks its clock only when a frame is whole, and then calls
  /// act().
  bool push(uint8_t byte) {
    decoder_.push(byte);
    return decoder_.next();
  }
  /// Of the frame that is coming in; 255: none is.
  uint8_t bytes_missing() const { return decoder_.missing(); }
  void act(uint32_t now_us) {
    do {
      act_once(now_us);
    } while (decoder_.next());
  }

  void sample(uint8_t leg, uint16_t counts, uint32_t now_us) {
    legs_[leg].sample(counts);
    sampled_us_ = now_us;
  }

  /// The tool's turn, as its sensor says it last [1/4096 turn].
  void sample_roll(uint16_t roll) { roll_ = roll; }

  /// One leg's law, and whether anything may drive at all.
  void step(uint8_t leg, uint32_t now_us) {
    watchdog_.tick(now_us);
    if (!may_drive()) {
      for (LegStopDrive& each : legs_) each.release();
      if (watchdog_.is_silent()) is_asked_ = false;
      return;
    }
    if (wish_.legs[leg].side == LegStopSide::Off) {
      legs_[leg].release();
    } else {
      legs_[leg].follow(wish_.legs[leg]);
    }
  }

  void sent(uint8_t leg) { legs_[leg].sent(); }
  /// The pulse for the next frame of the leg's servo [half us]; 0: none.
  uint16_t pulse_half_us(uint8_t leg) const { return legs_[leg].pulse_half_us(); }

  bool has_reply() const { return due_ != Answer::None; }
  /// @return length of the answer that is due, written to `to`; 0: none.
  template <typename Start = NoStart>
  uint8_t reply(uint8_t* to, uint32_t now_us, Start start = Start()) {
    const Answer due = due_;
    due_ = Answer::None;
    if (due == Answer::None) return 0;
    if (due == Answer::Identity) {
      Identity identity;
      identity.version = kProtocolVersion;
      identity.drive = static_cast<uint8_t>(Drive::Stop);
      identity.firmware = kFirmwareRevision;
      identity.unit = unit_;
      return encode_frame(identity, sequence_++, to, start);
    }
    Sensors sensors;
    sensors.echo = watchdog_.sequence();
    sensors.status = status();
    const uint32_t age = (now_us - sampled_us_) / 4;
    sensors.age_4us = static_cast<uint8_t>(age < 255 ? age : 255);
    for (uint8_t i = 0; i < kLegs; ++i)
      sensors.legs[i].counts = static_cast<int16_t>(legs_[i].counts());
    put_roll(roll_, sensors.legs);
    return encode_frame(sensors, sequence_++, to, start);
  }

  uint8_t status() const {
    uint8_t status = 0;
    if (is_configured()) status |= kStatusConfigured;
    if (is_driving()) status |= kStatusDriving;
    if (watchdog_.is_silent()) status |= kStatusSilent;
    if (after_reset_) status |= kStatusAfterReset;
    for (const LegStopDrive& leg : legs_) {
      if (leg.has_fault()) status |= kStatusSensorFault;
      if (leg.is_limited()) status |= kStatusLimited;
      if (leg.is_hot()) status |= kStatusHot;
    }
    return status;
  }
  bool is_driving() const {
    for (const LegStopDrive& leg : legs_) {
      if (leg.pulse_half_us() != 0) return true;
    }
    return false;
  }

 private:
  enum class Answer : uint8_t { None, Identity, Sensors };
  using Decoder = FrameDecoder<stop_arm_payload_bytes, kPayloadBytesOfLegConfig + kFrameOverhead>;

  void act_once(uint32_t now_us) {
    if (decoder_.kind() == kind_of(Hello{})) {
      watchdog_.forget();
      is_asked_ = false;
      after_reset_ = false;
      due_ = Answer::Identity;
      return;
    }
    Stop stop;
    LegConfig config;
    if (decoder_.read_frame(stop)) {
      if (!is_new(now_us)) return;
      wish_ = stop;
      is_asked_ = true;
    } else if (decoder_.read_frame(config)) {
      if (is_new(now_us) && !is_driving()) legs_[config.leg].configure(config);
    } else if (decoder_.kind() == kind_of(Release{}) && is_new(now_us)) {
      is_asked_ = false;
    }
  }

  bool is_new(uint32_t now_us) {
    if (!watchdog_.heard(decoder_.sequence(), now_us)) return false;
    due_ = Answer::Sensors;
    return true;
  }

  bool is_configured() const {
    for (const LegStopDrive& leg : legs_) {
      if (!leg.is_configured()) return false;
    }
    return true;
  }
  bool may_drive() const {
    for (const LegStopDrive& leg : legs_) {
      if (!leg.is_configured() || !leg.is_trusted() || leg.is_hot()) return false;
    }
    return is_asked_ && !after_reset_ && watchdog_.may_drive();
  }

  Decoder decoder_;
  Watchdog watchdog_;
  LegStopDrive legs_[kLegs];
  Stop wish_;
  uint32_t unit_;
  uint32_t sampled_us_ = 0;
  uint16_t roll_ = 0;
  uint8_t sequence_ = 0;
  Answer due_ = Answer::None;
  bool is_asked_ = false;
  bool after_reset_ = true;  ///< until the host has said hello, and so knows
};

}  // namespace firmware
}  // namespace carpus
