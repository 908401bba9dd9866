// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// CRC-16 of CCITT's polynomial x^16 + x^12 + x^5 + 1, least bit first as a serial line sends them
// and sent low byte first, so that a burst on the line is a burst to the polynomial. In a frame of
// ours (at most 47 bytes) it finds every change of up to three bits and every burst of up to 16
// [koopman2004cyclic].
#pragma once

#include <stdint.h>

namespace carpus {
namespace firmware {

constexpr uint16_t kFirstCrc = 0xFFFF;

/// A whole byte at once, without a table.
inline uint16_t add_to_crc(uint16_t crc, uint8_t byte) {
  byte = static_cast<uint8_t>(byte ^ static_cast<uint8_t>(crc));
  byte = static_cast<uint8_t>(byte ^ static_cast<uint8_t>(byte << 4));
  return static_cast<uint16_t>((static_cast<uint16_t>(byte) << 8 | crc >> 8) ^ (byte >> 4) ^
                               static_cast<uint16_t>(byte << 3));
}

}  // namespace firmware
}  // namespace carpus
