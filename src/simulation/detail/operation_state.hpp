// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole changing state of a world, as plain data: what undo restores apart from what stays
// spent.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/state_hash.hpp"
#include "core/units.hpp"
#include "procedure/views.hpp"
#include "simulation/snapshot.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation::detail {

/// The wire in bone. Its line is fixed where it engaged: origin + direction * travel.
struct WireLine {
  bool engaged = false;
  bool in_scaphoid = false;       ///< has entered the scaphoid on this line
  bool has_left = false;          ///< its tip is beyond the scaphoid's far cortex
  Vec3 origin;                    ///< where the tip was when it engaged [mm]
  Vec3 direction;                 ///< unit, into the bone
  double travel_mm = 0.0;         ///< tip from the origin
  double entry_at_mm = 0.0;       ///< travel at which it entered the scaphoid
  double chord_mm = 0.0;          ///< length of this line inside the scaphoid, gap included
  std::uint32_t wrong_bones = 0;  ///< bones told of on this line, bit by label
};

struct ScrewOnWire {
  std::int32_t index = -1;
  double length_mm = 0.0;
  double advance_mm = 0.0;  ///< tip below the scaphoid's entry
  bool told_seated = false;
};

/// What an undo brings back.
struct Operated {
  Instrument instrument = Instrument::GuideWire;
  Vec3 tip;             ///< of the instrument, after contact [mm]
  Vec3 shaft{0, 0, 1};  ///< unit, towards the hand
  WireLine wire;
  ScrewOnWire screw;
  double measured_mm = -1.0;
  std::uint32_t passes = 0;
  std::uint32_t far_exits = 0;
  double far_exit_mm = 0.0;
  std::uint32_t wrong_bones = 0;
  std::uint32_t completed_steps = 0;
  std::uint32_t shots_before_drive = 0;  ///< shots when Step::Drive was completed
};
static_assert(std::is_trivially_copyable_v<Operated>);

inline constexpr std::size_t kMaxCheckpoints = 16;

/// What an undo does not bring back, and the last tick's facts.
struct Spent {
  Tick tick = 0;
  std::uint32_t undos = 0;
  std::uint32_t shot_count = 0;
  bool finished = false;
  bool reverse_is_held = false;  ///< driver in reverse since the screw came off: let go first
  bool forward_is_held = false;  ///< driver forward since the last tick
  bool has_input = false;
  bool slip_is_told = false;  ///< since the driver started; decides an event only: not hashed
  Vec3 last_hand_tip;         ///< newest good input
  Vec3 last_hand_shaft{0, 0, 1};
  std::uint8_t touched_label = 0;
  Vec3 contact_normal;
  std::uint64_t hash = 0;
};

/// Adds what decides the future to the hash; in a fixed order, so that replays compare.
void add_to(StateHash& hash, const Operated& operated) noexcept;
void add_to(StateHash& hash, const Spent& spent) noexcept;

}  // namespace carpus::simulation::detail
