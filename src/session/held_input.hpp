// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is held between messages, and how it becomes the input of each tick. Any host steps its
// world with an InputSource, in the thread that steps: it allocates nothing and never waits.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "core/units.hpp"
#include "simulation/input.hpp"

namespace carpus::session {

using simulation::kHands;

/// What the hands and the wrist do until told otherwise: Input without its command. Plain bytes: it
/// crosses threads by copy.
struct HeldInput {
  std::array<simulation::HandInput, kHands> hands;
  simulation::WristPose wrist;
  simulation::CArmInput c_arm;
  /// Counts what was heard of each hand, and of the pedal: whoever holds a driver, or the pedal
  /// down, says so again and again.
  std::array<std::uint32_t, kHands> heard{};
  std::uint32_t pedal_heard = 0;

  constexpr bool operator==(const HeldInput&) const = default;
};
static_assert(std::is_trivially_copyable_v<HeldInput>);

/// Makes each tick's input of the newest that is held.
class InputSource {
 public:
  /// A driver runs only this long after its hand was last heard of: a page that is held up must not
  /// drill on.
  static constexpr Tick kDriverHoldTicks = 150;
  /// The pedal likewise; longer, since every time that it is let go is a look of its own.
  static constexpr Tick kPedalHoldTicks = 2000;

  explicit InputSource(const HeldInput& initial) noexcept : held_(initial) {}

  void hold(const HeldInput& newest) noexcept;
  /// Of the next tick, without having passed it: a host that cannot record it asks again.
  [[nodiscard]] simulation::Input input(const simulation::Command& command) const noexcept;
  /// The tick has passed.
  void passed() noexcept;

 private:
  HeldInput held_;
  std::array<Tick, kHands> ticks_since_heard_{};
  Tick ticks_since_pedal_ = 0;
};

}  // namespace carpus::session
