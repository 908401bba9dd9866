// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One tick against the processor's clock, and an input to begin with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>

#include "simulation/world.hpp"

namespace carpus::cli {

/// Time of this thread on its processor [us]: what other programs take is not in it.
inline double processor_us() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

inline float timed_step(simulation::World& world, const simulation::Input& input) {
  const double before = processor_us();
  world.step(input);
  return static_cast<float>(processor_us() - before);
}

/// Everything stays where it is.
inline simulation::Input at_rest(const simulation::Snapshot& now) {
  simulation::Input input;
  input.wrist = now.wrist;
  for (std::size_t hand = 0; hand < simulation::kHands; ++hand) {
    const std::uint8_t item = now.hands[hand].item;
    const auto& view = now.items[item < simulation::kMaxItems ? item : 0];
    input.hands[hand].tip_in_patient = view.tip_in_patient;
    input.hands[hand].shaft_in_patient = view.shaft_in_patient;
  }
  return input;
}

}  // namespace carpus::cli
