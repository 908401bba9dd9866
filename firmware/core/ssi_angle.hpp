// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What an MT6701 says over its serial line, 24 bits: 14 of the angle, 4 of its state (0 to 1: the
// magnet too strong, too weak; 2: pushed; 3: track lost), 6 of a checksum over those 18. And how
// angles of one turn become counts that go on.
#pragma once

#include <stdint.h>

namespace carpus {
namespace firmware {

constexpr uint32_t kAnglesOfTurn = 16384;

/// x^6 + x + 1, high bit first.
inline uint8_t crc6(uint32_t bits18) {
  uint8_t crc = 0;
  for (int8_t i = 17; i >= 0; --i) {
    const bool bit = ((bits18 >> i & 1U) != 0) != ((crc & 0x20U) != 0);
    crc = static_cast<uint8_t>((crc << 1 & 0x3F) ^ (bit ? 0x03 : 0x00));
  }
  return crc;
}

/// Counts of one encoder. A word that is damaged, or of an encoder that has lost its magnet, does
/// not count: after a few in a row the counts jump to where no arm can be, which the core takes for
/// the fault that it is.
class TurnCounter {
 public:
  static constexpr uint8_t kMostBad = 8;  ///< in a row: 2 ms
  static constexpr int32_t kNowhere = 500000;

  int32_t take(uint32_t word24) {
    const uint32_t said = word24 >> 6 & 0x3FFFF;
    const bool is_sound = crc6(said) == (word24 & 0x3F);
    const bool is_seen = (said & 0x8U) == 0 && (said & 0x3U) != 0x3U;
    if (!is_sound || !is_seen) {
      if (bad_ < kMostBad) {
        ++bad_;
      } else {
        is_away_ = !is_away_;  // to and fro: never trusted while it lasts
      }
      return is_away_ ? counts_ + kNowhere : counts_;
    }
    const int32_t angle = static_cast<int32_t>(said >> 4);
    if (!has_angle_) {
      counts_ = angle;
      has_angle_ = true;
    } else {
      int32_t step = (angle - counts_) & static_cast<int32_t>(kAnglesOfTurn - 1);
      if (step >= static_cast<int32_t>(kAnglesOfTurn / 2)) {
        step -= static_cast<int32_t>(kAnglesOfTurn);
      }
      counts_ += step;
    }
    bad_ = 0;
    is_away_ = false;
    return counts_;
  }

 private:
  int32_t counts_ = 0;
  uint8_t bad_ = 0;
  bool has_angle_ = false;
  bool is_away_ = false;
};

}  // namespace firmware
}  // namespace carpus
