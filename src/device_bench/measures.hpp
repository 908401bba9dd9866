// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a rig is worth: pressed, struck, led through free space.
#pragma once

#include <optional>
#include <vector>

#include "device_bench/rig.hpp"

namespace carpus::device_bench {

inline constexpr double kPressN = 2;
/// A wall that moves to and fro by more than this, or three quanta of its sensor, rings [mm].
inline constexpr double kStillMm = 0.06;

struct Press {
  double force_n = 0;        ///< that was reached, mean of the last half second
  double depth_mm = 0;       ///< at the sensors, then
  double to_and_fro_mm = 0;  ///< both ways, then: a slide one way is none
  double half_depth_mm = 0;  ///< when a quarter of the force was reached
  double most_depth_mm = 0;  ///< then
  bool has_let_go = false;   ///< a released hand
  bool has_reached = false;  ///< the force, before the hand meant to be 90 mm deep
  [[nodiscard]] bool is_still(double quantum_mm) const;
};
/// The hand leans on the wall until it feels 2 N, and stays for 1.2 s. A released hand has pressed
/// as a firm one, and then lets go.
[[nodiscard]] Press press(Rig& rig);

struct Strike {
  double most_given_mj = 0;  ///< more than was put in, at any time
  double put_in_mj = 0;      ///< the most that the wall held at a time
  double deepest_mm = 0;
  double pulled_back_n = 0;  ///< by the drives when the hand left
};
/// The hand comes at this speed, means to go on for what 4 N of its own stiffness are, at most
/// 20 mm, and comes back. A released hand was a light one until 5 mm before the wall.
[[nodiscard]] Strike strike(Rig& rig, double speed_mm_per_s);

/// Root mean square of what the hand feels on a way at up to 0.1 m/s without a wall, 2 s [N].
[[nodiscard]] double free_space_n(Rig& rig);

struct Sample {
  double s = 0;
  double intent_mm = 0;  ///< into the wall
  double depth_mm = 0;
  double force_n = 0;
};
/// In at 50 mm/s until the hand would press 2 N on something rigid, half a second of it, and out.
[[nodiscard]] std::vector<Sample> touch(Rig& rig);

}  // namespace carpus::device_bench
