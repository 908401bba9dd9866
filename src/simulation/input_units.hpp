// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An input as whole numbers, in the units of quantisation.hpp: what a recording writes, and what
// differs from one tick to the next.
#pragma once

#include <array>
#include <cstdint>

#include "simulation/input.hpp"

namespace carpus::simulation {

struct InputUnits {
  struct Hand {
    std::array<std::int64_t, 3> tip{};
    std::array<std::int64_t, 3> shaft{};
    std::int64_t thrust = 0;
    std::uint8_t driver = 0;
    std::uint8_t guidance = 0;
    bool operator==(const Hand&) const = default;
  };
  struct CArm {
    std::array<std::int64_t, 2> stand{};
    std::uint8_t pedal = 0;
    bool operator==(const CArm&) const = default;
  };
  struct What {
    std::uint8_t kind = 0;
    std::uint8_t hand = 0;
    std::uint8_t index = 0;
    std::array<std::int64_t, 2> view{};
    bool operator==(const What&) const = default;
  };
  std::array<Hand, kHands> hands;
  std::array<std::int64_t, 4> wrist{};
  CArm c_arm;
  What command;
  bool operator==(const InputUnits&) const = default;
};

[[nodiscard]] InputUnits in_units(const Input& input) noexcept;

/// `input_of(in_units(input))` is `quantised(input)`.
[[nodiscard]] Input input_of(const InputUnits& units) noexcept;

/// Whether every number is one that `in_units` gives.
[[nodiscard]] bool is_an_input(const InputUnits& units) noexcept;

}  // namespace carpus::simulation
