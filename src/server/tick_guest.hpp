// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Who else takes part in each tick, in the simulation's thread: devices that hold a hand.
#pragma once

#include "simulation/input.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::server {

class TickGuest {
 public:
  TickGuest() = default;
  virtual ~TickGuest() = default;
  TickGuest(const TickGuest&) = delete;
  TickGuest& operator=(const TickGuest&) = delete;

  /// Before a tick: changes of its input what is its own. Neither waits, allocates nor throws.
  /// @param last  state that the tick before left.
  virtual void before(simulation::Input& input, const simulation::Snapshot& last) noexcept = 0;
  /// After it. Neither waits, allocates nor throws. Not called while no time passes.
  virtual void after(const simulation::Snapshot& now) noexcept = 0;
};

}  // namespace carpus::server
