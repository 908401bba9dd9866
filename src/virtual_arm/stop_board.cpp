// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "virtual_arm/stop_board.hpp"

#include <algorithm>
#include <limits>

#include "arm/potentiometer.hpp"

namespace carpus::virtual_arm {
namespace {
constexpr double kConversionUs = 96;
constexpr int kConversionsOfASample = 4;
constexpr double kSlotUs = 13333 * 0.5;
/// From a frame's last byte to the answer's first, about as the ATmega needs.
constexpr double kAnswerUs = 70;
constexpr double kNever = std::numeric_limits<double>::infinity();
}  // namespace

CoreStopBoard::CoreStopBoard(std::uint32_t unit) : unit_(unit), arm_(unit) {}

void CoreStopBoard::receive(std::uint8_t byte) { coming_.push_back({byte, now_us_ + kByteUs}); }
void CoreStopBoard::set_wiper(int leg, double share) { wipers_[leg] = share; }
bool CoreStopBoard::is_supply_on() const { return arm_.is_driving(); }

void CoreStopBoard::brown_out() {
  arm_ = firmware::StopArm(unit_);
  coming_.clear();
  going_.clear();
  pulsing_leg_ = -1;
  sum_ = 0;
  conversions_ = 0;
  next_slot_us_ = now_us_ + 10'000;
  next_conversion_us_ = now_us_ + kConversionUs;
}

void CoreStopBoard::convert() {
  if (leg_ == 3) {  // behind the legs, once a round
    arm_.sample_roll(static_cast<std::uint16_t>(arm::counts_of(roll_, 10) << 2));
    leg_ = 0;
    next_conversion_us_ += kConversionUs;
    return;
  }
  sum_ = static_cast<std::uint16_t>(sum_ + arm::counts_of(wipers_[leg_], 10));
  next_conversion_us_ += kConversionUs;
  if (++conversions_ < kConversionsOfASample) return;
  const auto now = static_cast<std::uint32_t>(now_us_);
  arm_.sample(static_cast<std::uint8_t>(leg_), sum_, now);
  arm_.step(static_cast<std::uint8_t>(leg_), now);
  sum_ = 0;
  conversions_ = 0;
  ++leg_;
}

void CoreStopBoard::do_slot() {
  const auto leg = static_cast<std::uint8_t>(slot_leg_);
  const std::uint16_t pulse = arm_.pulse_half_us(leg);
  if (pulse != 0) {
    arm_.sent(leg);
    pulsing_leg_ = slot_leg_;
    pulse_begun_us_ = now_us_;
    pulse_end_us_ = now_us_ + 0.5 * pulse;
  }
  slot_leg_ = (slot_leg_ + 1) % 3;
  next_slot_us_ += kSlotUs;
}

void CoreStopBoard::answer() {
  std::uint8_t bytes[firmware::kMaxDeviceFrameBytes];
  const int length = arm_.reply(bytes, static_cast<std::uint32_t>(now_us_));
  double at = std::max(line_free_us_, now_us_ + kAnswerUs);
  for (int i = 0; i < length; ++i) going_.push_back({bytes[i], at += kByteUs});
  line_free_us_ = at;
}

void CoreStopBoard::run_to_us(double us) {
  for (;;) {
    const double byte_in = coming_.empty() ? kNever : coming_.front().us;
    const double byte_out = going_.empty() ? kNever : going_.front().us;
    const double pulse_end = pulsing_leg_ >= 0 ? pulse_end_us_ : kNever;
    const double next =
        std::min({byte_in, byte_out, pulse_end, next_conversion_us_, next_slot_us_});
    if (!(next <= us)) break;
    now_us_ = next;
    if (next == byte_in) {
      const std::uint8_t byte = coming_.front().byte;
      coming_.pop_front();
      arm_.take(byte, static_cast<std::uint32_t>(now_us_));
      if (arm_.has_reply()) answer();
    } else if (next == byte_out) {
      const std::uint8_t byte = going_.front().byte;
      going_.pop_front();
      if (on_byte) on_byte(byte, next);
    } else if (next == pulse_end) {
      const int leg = pulsing_leg_;
      pulsing_leg_ = -1;
      if (on_pulse) on_pulse(leg, pulse_begun_us_, pulse_end_us_ - pulse_begun_us_);
    } else if (next == next_conversion_us_) {
      convert();
    } else {
      do_slot();
    }
  }
  now_us_ = us;
}

}  // namespace carpus::virtual_arm
