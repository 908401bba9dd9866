// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether the host is alive, and which of its frames are new. A frame acts once and only in order;
// a host that is silent loses the motors, and gets them back only by several new frames in a row,
// so that one old frame out of some buffer moves nobody's hand.
#pragma once

#include "firmware/core/wire.hpp"

namespace carpus {
namespace firmware {

constexpr uint32_t kSilenceUs = uint32_t{kSilenceMs} * 1000;
constexpr uint8_t kFramesToDrive = 3;

class Watchdog {
 public:
  /// A whole frame came at `now_us` (which wraps). @return whether it is new, and acts.
  bool heard(uint8_t sequence, uint32_t now_us) {
    tick(now_us);
    const uint8_t ahead = static_cast<uint8_t>(sequence - sequence_);
    if (has_heard_ && (ahead == 0 || ahead > 127)) return false;
    sequence_ = sequence;
    has_heard_ = true;
    heard_us_ = now_us;
    if (in_row_ < kFramesToDrive) ++in_row_;
    return true;
  }

  /// To be called at least once a millisecond.
  void tick(uint32_t now_us) {
    if (!has_heard_ || now_us - heard_us_ <= kSilenceUs) return;
    forget();
  }

  /// As after a reset: the next frame counts as the first, whatever its sequence.
  void forget() {
    has_heard_ = false;
    in_row_ = 0;
  }

  bool may_drive() const { return in_row_ == kFramesToDrive; }
  bool is_silent() const { return !has_heard_; }
  uint8_t sequence() const { return sequence_; }
  /// Since the last new frame [us]; kSilenceUs where silent.
  uint32_t silence_us(uint32_t now_us) const {
    return has_heard_ ? now_us - heard_us_ : kSilenceUs;
  }

 private:
  uint32_t heard_us_ = 0;
  uint8_t sequence_ = 0;
  uint8_t in_row_ = 0;
  bool has_heard_ = false;
};

}  // namespace firmware
}  // namespace carpus
