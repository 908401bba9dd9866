// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/held_input.hpp"

namespace carpus::session {

void InputSource::hold(const HeldInput& newest) noexcept {
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    if (newest.heard[hand] != held_.heard[hand]) ticks_since_heard_[hand] = 0;
  }
  if (newest.pedal_heard != held_.pedal_heard) ticks_since_pedal_ = 0;
  held_ = newest;
}

simulation::Input InputSource::input(const simulation::Command& command) const noexcept {
  simulation::Input input{held_.hands, held_.wrist, held_.c_arm, command};
  for (std::size_t hand = 0; hand < kHands; ++hand) {
    if (ticks_since_heard_[hand] >= kDriverHoldTicks) {
      input.hands[hand].driver = simulation::Driver::Off;
    }
  }
  if (ticks_since_pedal_ >= kPedalHoldTicks) input.c_arm.pedal_is_down = false;
  return input;
}

void InputSource::passed() noexcept {
  for (Tick& ticks : ticks_since_heard_) ++ticks;
  ++ticks_since_pedal_;
}

}  // namespace carpus::session
