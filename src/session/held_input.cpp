// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/held_input.hpp"

namespace carpus::session {

void InputSource::hold(const HeldInput& newest) noexcept {
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    if (newest.heard[hand] != held_.heard[hand]) ticks_since_heard_[hand] = 0;
  }
  held_ = newest;
}

simulation::Input InputSource::input(const simulation::Command& command) const noexcept {
  simulation::Input input{held_.hands, held_.wrist, command};
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    if (ticks_since_heard_[hand] >= kDriverHoldTicks) {
      input.hands[hand].driver = simulation::Driver::Off;
    }
  }
  return input;
}

void InputSource::passed() noexcept {
  for (Tick& ticks : ticks_since_heard_) ++ticks;
}

}  // namespace carpus::session
