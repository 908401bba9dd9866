// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How the windings of drive B's motors stand to their encoders, found by letting each motor follow
// a field that the firmware turns: up, a third of an electrical turn on, back again. Where the
// rotor comes to rest is the field's angle, beside what rubs; that is found from both sides, and
// falls out. The two places must be a third of an electrical turn apart, 780 counts, or the motor
// did not follow: blocked, not supplied, a winding broken.
#pragma once

#include "firmware/core/gimbal_commutation.hpp"

namespace carpus {
namespace firmware {

class MotorAlignment {
 public:
  /// One ampere: 380 N mm at a joint, some 5 N at the tip.
  static constexpr float kVolts = 2.8F;

  void forget() { *this = MotorAlignment(); }
  bool is_running() const { return progress_ == Progress::Turning; }
  void start() {
    forget();
    progress_ = Progress::Turning;
  }

  /// One step of 250 us. @param counts  of all encoders. @return the motor that turns.
  uint8_t step(const int32_t* counts) {
    if (!is_running()) return 0;
    const uint8_t motor = motor_;
    if (at_ >= kRestSteps - kMeanSteps && at_ < kRestSteps) sums_[place_] += counts[motor];
    if (++at_ >= (place_ == kPlaces - 1 ? kRestSteps : kRestSteps + kTurnSteps)) next_place();
    return motor;
  }
  /// The field in which the motor that turns now stands.
  WindingVolts volts() const {
    if (!is_running()) return WindingVolts();
    return field_volts(kVolts * strength(), angle());
  }

  Progress progress() const { return progress_; }
  const WindingsOf& found(uint8_t motor) const { return found_[motor]; }

 private:
  /// Half a second to come to rest, of which the last 50 ms are looked at; 400 ms to the next.
  static constexpr uint16_t kRestSteps = 2000;
  static constexpr uint16_t kMeanSteps = 200;
  static constexpr uint16_t kTurnSteps = 1600;
  /// A third of a turn: 16384 / 7 / 3.
  static constexpr int32_t kThirdCounts = 780;
  static constexpr int32_t kMostBesideCounts = 200;
  static constexpr uint16_t kThird = 21845;

  /// Angle 0, to come to a known place at all; a third of a turn; and 0 again. At each the field
  /// rests, then it turns to the next.
  static constexpr uint8_t kPlaces = 3;

  float strength() const {
    constexpr uint16_t kSoftSteps = 800;
    return place_ == 0 && at_ < kSoftSteps ? static_cast<float>(at_) / kSoftSteps : 1.0F;
  }
  uint16_t angle() const {
    const uint32_t turned =
        at_ < kRestSteps ? 0U : uint32_t{kThird} * (at_ - kRestSteps) / kTurnSteps;
    if (place_ == 0) return static_cast<uint16_t>(turned);
    return place_ == 1 ? static_cast<uint16_t>(kThird - turned) : uint16_t{0};
  }

  void next_place() {
    at_ = 0;
    if (++place_ < kPlaces) return;
    const int32_t back = sums_[2] / kMeanSteps;
    const int32_t way = sums_[1] / kMeanSteps - back;
    const int32_t size = way < 0 ? -way : way;
    if (size < kThirdCounts - kMostBesideCounts || size > kThirdCounts + kMostBesideCounts) {
      forget();
      progress_ = Progress::Refused;
      return;
    }
    // The third was come to from below, 0 from above: in the middle of both what rubs falls out.
    WindingsOf& found = found_[motor_];
    found.windings = way > 0 ? Windings::Along : Windings::Against;
    found.electrical_zero = static_cast<uint16_t>(kThird / 2 - found.electrical_at(back + way / 2));
    place_ = 0;
    for (int32_t& sum : sums_) sum = 0;
    if (++motor_ < kMotors) return;
    motor_ = 0;
    progress_ = Progress::Found;
  }

  static constexpr uint8_t kMotors = 3;

  WindingsOf found_[kMotors];
  int32_t sums_[kPlaces] = {0, 0, 0};
  uint16_t at_ = 0;
  uint8_t place_ = 0;
  uint8_t motor_ = 0;
  Progress progress_ = Progress::Waiting;
};

}  // namespace firmware
}  // namespace carpus
