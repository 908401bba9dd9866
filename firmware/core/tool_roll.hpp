// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The turn of the tool in its gimbal, or of a scope's light post: 4096 to a turn, a third of it
// with each leg of drive A's answer, which so is no byte longer.
#pragma once

#include "firmware/core/wire.hpp"

namespace carpus {
namespace firmware {

constexpr uint16_t kRollsOfTurn = 4096;

inline void put_roll(uint16_t roll, LegReading* legs) {
  for (uint8_t i = 0; i < 3; ++i) {
    legs[i].roll_part = static_cast<int16_t>(roll & 0xF);
    roll = static_cast<uint16_t>(roll >> 4);
  }
}
inline uint16_t roll_of(const LegReading* legs) {
  return static_cast<uint16_t>(legs[0].roll_part | legs[1].roll_part << 4 | legs[2].roll_part << 8);
}

}  // namespace firmware
}  // namespace carpus
