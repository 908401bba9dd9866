// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Situations in which a simulation tick is timed: scripted inputs through a world, on any case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "procedure/procedure.hpp"

namespace carpus::cli {

/// Times of single ticks [us], of the thread's processor time: what other programs take is not in
/// it.
struct SceneTimes {
  std::string scene;
  std::vector<float> microseconds;
};

/// Costs beside the tick.
struct ExerciseCosts {
  double set_up_ms = 0.0;              ///< of a world, median
  double undo_us = 0.0;                ///< of a tick with Undo after bone was removed, worst
  double memory_mib = 0.0;             ///< of a world, beyond the case
  double replay_speed = 0.0;           ///< simulated over real time, of one whole operation
  double recording_bytes_per_s = 0.0;  ///< of the same operation
};

struct TickBench {
  std::vector<SceneTimes> scenes;  ///< in the order of docs/json.md
  ExerciseCosts costs;
  std::uint64_t unresolved_contacts = 0;
};

/// Runs all scenes: `quiet` (hands at rest), `two_hands_in_contact` (two probes slide along the
/// target), `wrist_moving` (through all of its range, an instrument at the bone), `drilling` and
/// `screw_going_in` (of whole operations by the scripted expert); of an arthroscopy `quiet`,
/// `scope_in_joint` and, as far as the expert comes to it, `disc_yields`, `ligament_yields`,
/// `disc_and_ligament` and, with a shaver, `shaving` (while it runs), then those of
/// crowded_joint_scenes.hpp; where portals are made `quiet`, `on_skin` and `under_skin`.
/// @param ticks  measured a scene.
[[nodiscard]] TickBench time_ticks(const cases::CaseData& data,
                                   const procedure::Procedure& procedure,
                                   std::size_t ticks);

}  // namespace carpus::cli
