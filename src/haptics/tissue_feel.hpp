// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How tissue and tools feel, as data (data/tissue_feel.json, each figure with its mark). What the
// world pushes back with is bone alone; cartilage and soft tissue lie over it in the device.
#pragma once

#include <string_view>

#include "haptics/local_planes.hpp"

namespace carpus::haptics {

struct TissueFeel {
  SurfaceFeel feel;
  double thickness_mm = 0;  ///< over the bone; 0: it is the bone
};

/// A tool that a motor turns.
struct DrillingFeel {
  double hardest_bone_n = 0;  ///< thrust that no bone exceeds
  double share_of_peak = 0;   ///< of a device's peak force that stands for it
  double turns_per_s = 0;
  double edges = 0;
  double slows_share = 0;  ///< of its speed, in the hardest bone
  double free_n = 0;       ///< shake of the motor alone
  double most_n = 0;       ///< in the hardest bone, at full feed
  double least_cut_share = 0;
};

/// A tool that a hand turns, where the device cannot turn back.
struct TurningFeel {
  double detents_per_turn = 0;
  double pulse_ms = 0;
  double pulse_hz = 0;
  double least_n = 0;
  double most_n = 0;
  double full_torque_n_mm = 0;
};

struct FeelTable {
  TissueFeel bone;
  TissueFeel cartilage;
  TissueFeel soft_tissue;
  double joint_gap_mm = 0;  ///< bone that faces another so near has cartilage
  DrillingFeel drilling;
  TurningFeel turning;
};

/// What the program is built with. Read at the first call, which allocates: not in a loop.
[[nodiscard]] const FeelTable& feel_table();

/// @throws InvalidInput naming the field; each needs a mark, and no other is there.
[[nodiscard]] FeelTable read_feel_table(std::string_view json);

}  // namespace carpus::haptics
