// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The tables of `carpus device bench`: a row for each law, drive and hand, and how long a command
// takes, stage by stage.
#pragma once

#include <string>
#include <vector>

#include "device_bench/rig.hpp"

namespace carpus::device_bench {

struct Row {
  Law law = Law::Ours;
  firmware::Drive drive = firmware::Drive::Motor;
  HandModel hand;
  /// Drive B: of the wall, the stiffest of a row of trials below which none rang; 0: none of them.
  /// Drive A, and the thesis's arm: the stop's own, from the place where 0.5 N are felt to 2 N.
  double largest_stable_n_per_mm = 0;
  double free_space_n = 0;
  bool has_free_space = false;  ///< a released hand feels none
  /// Pressed down; and the worst of five directions.
  double penetration_mm_at_2n = 0;
  double penetration_worst_mm_at_2n = 0;
  bool has_penetration = false;
  /// The most that the drives gave more than they were given, of all strikes.
  double energy_returned_mj = 0;
  /// Backwards, on a hand that leaves the wall.
  double pull_back_n = 0;
  bool limit_cycle = false;  ///< at 2 N/mm, in any direction
};

/// @param seeds  specimens of every part that are tried; the row holds the worst.
[[nodiscard]] Row measure_row(Law law,
                              firmware::Drive drive,
                              const HandModel& hand,
                              int seeds,
                              const BoardMaker& board = {});

/// Times on the way from a hand's move to what it feels of it [us].
struct Stage {
  std::string name;
  double median_us = 0;
  double worst_us = 0;
};
[[nodiscard]] std::vector<Stage> measure_latency(Law law,
                                                 firmware::Drive drive,
                                                 const BoardMaker& board = {});

}  // namespace carpus::device_bench
