// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {
namespace {

void add(StateHash& hash, const Vec3& v) noexcept {
  hash.add(v.x);
  hash.add(v.y);
  hash.add(v.z);
}

void add(StateHash& hash, bool value) noexcept { hash.add(std::uint64_t{value}); }

}  // namespace

void add_to(StateHash& hash, const Operated& operated) noexcept {
  hash.add(static_cast<std::uint64_t>(operated.instrument));
  add(hash, operated.tip);
  add(hash, operated.shaft);
  const WireLine& wire = operated.wire;
  add(hash, wire.engaged);
  add(hash, wire.in_scaphoid);
  add(hash, wire.has_left);
  add(hash, wire.origin);
  add(hash, wire.direction);
  hash.add(wire.travel_mm);
  hash.add(wire.entry_at_mm);
  hash.add(wire.chord_mm);
  hash.add(std::uint64_t{wire.wrong_bones});
  const ScrewOnWire& screw = operated.screw;
  hash.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(screw.index)));
  hash.add(screw.length_mm);
  hash.add(screw.advance_mm);
  add(hash, screw.told_seated);
  hash.add(operated.measured_mm);
  hash.add(std::uint64_t{operated.passes});
  hash.add(std::uint64_t{operated.far_exits});
  hash.add(operated.far_exit_mm);
  hash.add(std::uint64_t{operated.wrong_bones});
  hash.add(std::uint64_t{operated.completed_steps});
  hash.add(std::uint64_t{operated.shots_before_drive});
}

void add_to(StateHash& hash, const Spent& spent) noexcept {
  hash.add(std::uint64_t{spent.tick});
  hash.add(std::uint64_t{spent.undos});
  hash.add(std::uint64_t{spent.shot_count});
  add(hash, spent.finished);
  add(hash, spent.reverse_is_held);
  add(hash, spent.forward_is_held);
  add(hash, spent.last_hand_tip);
  add(hash, spent.last_hand_shaft);
  hash.add(std::uint64_t{spent.touched_label});
  add(hash, spent.contact_normal);
}

}  // namespace carpus::simulation::detail
