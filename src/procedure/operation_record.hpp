// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What was done, as far as the score needs it: plain values that the simulation hands over.
#pragma once

#include <cstdint>
#include <vector>

#include "core/units.hpp"
#include "geometry/vec3.hpp"
#include "procedure/step.hpp"
#include "procedure/views.hpp"

namespace carpus::procedure {

/// One operation, finished or not. Frame Patient, posed case [mm].
struct OperationRecord {
  bool wire_in_scaphoid = false;  ///< the wire lies in the scaphoid now
  Vec3 entry_in_patient{};        ///< where it entered the scaphoid's surface
  Vec3 direction_in_patient{};    ///< unit, from the entry towards the tip
  double wire_depth_mm = 0.0;     ///< entry to tip
  double measured_mm = -1.0;      ///< last reading of the depth gauge, -1 for none
  std::int32_t screw_index = -1;  ///< in screw_catalogue(), -1 for none
  double screw_advance_mm = 0.0;  ///< depth of the screw's tip below the entry
  std::uint32_t passes = 0;       ///< how often the wire entered bone anew
  std::uint32_t far_exits = 0;    ///< how often its tip left the scaphoid on the far side
  double far_exit_mm = 0.0;       ///< how far the tip was beyond the far cortex, at most
  std::uint32_t wrong_bones = 0;  ///< bit `label`: the wire entered this bone
  std::uint32_t undos = 0;
  std::vector<Shot> shots;
  Tick ticks = 0;                     ///< duration
  std::uint32_t completed_steps = 0;  ///< bit i: Step i
  bool finished = false;
};

}  // namespace carpus::procedure
