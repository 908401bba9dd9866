// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fluid in the joint that is looked into: whether a procedure has it, and what came of it.
#pragma once

#include <cstdint>

#include "core/units.hpp"

namespace carpus::procedure {

struct FluidUse {
  bool has_tourniquet = true;
  [[nodiscard]] bool operator==(const FluidUse&) const = default;
};

/// What is set by a command; each with a value (simulation/input.hpp).
enum class FluidControl : std::uint8_t {
  Inflow = 0,   ///< steps of FluidSource::step_mmhg
  Outflow = 1,  ///< 0 closed, 1 open
  Flush = 2,    ///< for some seconds
  Dry = 3,      ///< 0 with fluid, 1 without
};
inline constexpr std::uint8_t kFluidControls = 4;

/// What an exercise is judged by.
struct FluidFacts {
  double used_ml = 0;         ///< that ran in
  double tissue_ml = 0;       ///< that went into the tissue about the joint
  Tick over_limit_ticks = 0;  ///< with the pressure above FluidJoint::most_mmhg
  Tick watched_ticks = 0;     ///< with the scope in a joint
  Tick clouded_ticks = 0;     ///< of these, with the view clouded
  bool operator==(const FluidFacts&) const = default;
};

}  // namespace carpus::procedure
