// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One leg of drive A: a hobby servo whose horn carries a slot, in which the leg moves freely. In
// free space the slot follows the leg, and the hand feels nothing; at a surface an edge of the slot
// stands still there, and the leg meets steel. No spring is computed, so nothing can ring at the
// servo's 50 Hz.
//
//   free:  horn = leg + lead        (the lead makes up for servo and frame)
//   stop:  horn = max(leg + lead, wall + gap)   or, for the other side, min(leg + lead, wall - gap)
//
// Integers only: an 8-bit processor takes this in some tens of microseconds. Angles are in units of
// pi/8192 rad; "fine" ones in sixteenths of that.
#pragma once

#include "firmware/core/wire.hpp"

namespace carpus {
namespace firmware {

/// Time from one sample of a leg to the next, which the board keeps [us].
constexpr uint16_t kSamplePeriodUs = 1248;
/// What is summed up in a sample: four conversions of 10 bits.
constexpr uint16_t kMostCounts = 4 * 1023;
/// Nearer than 1 % to an end of its travel the potentiometer is broken or unplugged: its end
/// voltage is at most 0.5 % [yaacoub2008] appendix B.2, and the arm stops before that.
constexpr uint16_t kRailCounts = kMostCounts / 100;
/// 3 samples, 4 ms: a bounce of the wiper is shorter.
constexpr uint8_t kBadSamplesToFault = 3;
/// 32 samples, 40 ms, until a sensor is believed again.
constexpr uint8_t kGoodSamplesToTrust = 32;
/// No leg turns by 8.8 degrees in a sample: 120 rad/s.
constexpr int16_t kMostAngleStep = 400;

/// 48 samples of 1248 us: 60 ms, a frame of the servo and its lag.
constexpr int8_t kLeadSamples = 48;
/// The lead fades over the last 2.8 degrees before the wall, some 5 mm at the tip: a stop that is
/// led in contact pumps energy into the hand.
constexpr uint8_t kLeadFadeShift = 7;
/// Of the velocity: 2^4 samples, 20 ms.
constexpr uint8_t kVelocityShift = 4;

/// Most change of a pulse from one frame to the next, in half microseconds: a little more than the
/// servo's own speed; and where it would push the leg before it, 45 degrees a second.
constexpr int16_t kMostPulseStep = 160;
constexpr int16_t kMostPushStep = 20;
/// The stop gives way where the leg is pressed so far past it: 4 degrees, where the servo gives all
/// it has.
constexpr int16_t kMostPress = 182;
/// What a servo bears for ever, of kMostPress, and the time constant of its heat: 2^14 samples, 20
/// s.
constexpr int16_t kRestingPress = 120;
constexpr uint8_t kHeatShift = 14;

class LegStopDrive {
 public:
  /// @return false where the numbers make no sense together.
  bool configure(const LegConfig& config) {
    if (config.gain == 0 || config.pulse_per_turn_us == 0 ||
        config.least_pulse_us >= config.most_pulse_us) {
      return false;
    }
    config_ = config;
    is_configured_ = true;
    good_ = 0;
    return true;
  }
  bool is_configured() const { return is_configured_; }

  /// One sample: the sum of four conversions.
  void sample(uint16_t counts) {
    counts_ = counts;
    const bool is_on_rail = counts < kRailCounts || counts > kMostCounts - kRailCounts;
    // Shifts, here and below: an 8-bit processor takes forty microseconds for a division.
    const int32_t fine = (static_cast<int32_t>(counts) - config_.zero_counts) * config_.gain >> 8;
    const int32_t step = fine - fine_angle_;
    const bool is_jump =
        good_ == kGoodSamplesToTrust && (step > 16 * kMostAngleStep || step < -16 * kMostAngleStep);
    if (is_on_rail || is_jump) {
      if (bad_ < kBadSamplesToFault && ++bad_ == kBadSamplesToFault) good_ = 0;
      return;
    }
    bad_ = 0;
    if (good_ < kGoodSamplesToTrust) {
      ++good_;
      velocity_ = 0;
    } else {
      velocity_ += step - (velocity_ >> kVelocityShift);
    }
    fine_angle_ = fine;
    if (is_configured_) step_heat();
  }

  /// The pulse that the wish asks for now, no farther from the last one sent than it may go.
  void follow(const LegStop& stop) {
    // Every second call is enough for a servo that listens each 20 ms, and a tenth of the ATmega's
    // time.
    rests_ = pulse_half_us_ != 0 && !rests_;
    if (rests_) return;
    const int16_t leg = angle();
    int32_t lead = (velocity_ >> kVelocityShift) * kLeadSamples >> 4;
    int32_t horn = leg;
    press_ = 0;
    is_pushing_ = false;
    const bool is_below = stop.side == LegStopSide::NotBelow;
    if (is_below || stop.side == LegStopSide::NotAbove) {
      const int32_t away = is_below ? int32_t{leg} - stop.angle : int32_t{stop.angle} - leg;
      if (away < 1 << kLeadFadeShift) lead = away > 0 ? lead * away >> kLeadFadeShift : 0;
      // Pressed farther than it may be, the stop is where the leg is.
      const int32_t press = away < 0 ? -away : 0;
      press_ = static_cast<int16_t>(press < kMostPress ? press : kMostPress);
      is_limited_ = press > kMostPress;
      const int32_t given_way = is_limited_ ? press - kMostPress : 0;
      const int32_t wall = is_below ? stop.angle - given_way : stop.angle + given_way;
      horn += lead;
      is_pushing_ = press > 0;
      if (is_below && horn < wall + config_.gap) horn = wall + config_.gap;
      if (!is_below && horn > wall - config_.gap) horn = wall - config_.gap;
    } else {
      is_limited_ = false;
      horn += lead;
    }
    const int32_t wished = half_us_at(horn);
    int16_t most = is_pushing_ ? kMostPushStep : kMostPulseStep;
    int32_t pulse = wished;
    // Where nothing was sent the horn's place is not known: it begins around the leg.
    const int32_t from = sent_half_us_ != 0 ? sent_half_us_ : half_us_at(leg);
    if (pulse > from + most) pulse = from + most;
    if (pulse < from - most) pulse = from - most;
    pulse_half_us_ = clamp_pulse(pulse);
  }

  /// The board has begun the pulse that `pulse_half_us` said.
  void sent() { sent_half_us_ = pulse_half_us_; }
  void release() {
    pulse_half_us_ = 0;
    sent_half_us_ = 0;
    press_ = 0;
    is_limited_ = false;
  }

  uint16_t pulse_half_us() const { return pulse_half_us_; }
  uint16_t counts() const { return counts_; }
  int16_t angle() const { return static_cast<int16_t>(fine_angle_ >> 4); }
  bool is_trusted() const { return good_ == kGoodSamplesToTrust; }
  bool has_fault() const { return bad_ == kBadSamplesToFault; }
  bool is_limited() const { return is_limited_; }
  bool is_hot() const { return is_hot_; }

 private:
  int32_t half_us_at(int32_t horn) const {
    return 2 * int32_t{config_.pulse_at_zero_us} + (horn * config_.pulse_per_turn_us >> 12);
  }
  uint16_t clamp_pulse(int32_t half_us) const {
    if (half_us < 2 * int32_t{config_.least_pulse_us})
      half_us = 2 * int32_t{config_.least_pulse_us};
    if (half_us > 2 * int32_t{config_.most_pulse_us}) half_us = 2 * int32_t{config_.most_pulse_us};
    return static_cast<uint16_t>(half_us);
  }
  /// Heat goes as the square of the press; hot where a press above the resting one has lasted.
  void step_heat() {
    const int32_t press = pulse_half_us_ == 0 ? 0 : press_;
    heat_ += press * press - (heat_ >> kHeatShift);
    const int32_t most = (int32_t{kRestingPress} * kRestingPress) << kHeatShift;
    if (heat_ > most) is_hot_ = true;
    if (heat_ < most / 2) is_hot_ = false;
  }

  LegConfig config_;
  int32_t fine_angle_ = 0;
  int32_t velocity_ = 0;  ///< 2^kVelocityShift times the filtered step
  int32_t heat_ = 0;
  uint16_t counts_ = 0;
  uint16_t pulse_half_us_ = 0;
  uint16_t sent_half_us_ = 0;
  int16_t press_ = 0;
  uint8_t bad_ = 0;
  uint8_t good_ = 0;
  bool is_configured_ = false;
  bool is_pushing_ = false;
  bool is_limited_ = false;
  bool is_hot_ = false;
  bool rests_ = false;
};

}  // namespace firmware
}  // namespace carpus
