// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "virtual_arm/virtual_arm.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::virtual_arm {

void VirtualArm::send(std::span<const std::uint8_t> bytes) {
  double at = std::max(now_us_, line_free_us_);
  for (const std::uint8_t byte : bytes) {
    line_.push_back({byte, at});
    at += kByteUs;
  }
  line_free_us_ = at;
}

void VirtualArm::take_line(double us, const std::function<void(std::uint8_t)>& begin) {
  while (!line_.empty() && line_.front().us < us) {
    begin(line_.front().byte);
    line_.pop_front();
  }
}

double share_of_turn(double rad) noexcept {
  const double turns = rad / (2 * kPi);
  const double share = turns - std::floor(turns);
  return share < 1 ? share : 0;
}

}  // namespace carpus::virtual_arm
