// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "simulation/recording.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation {

/// Whether a keyframe is due for the state that a tick left: every ten seconds, and after an undo,
/// since what that goes back to may lie before the keyframe that a replay begins at.
[[nodiscard]] inline bool is_keyframe_due(const Snapshot& now) noexcept {
  if (now.tick % kKeyframeTicks == 0) return true;
  const auto* const end = now.events.begin() + now.event_count;
  return std::any_of(now.events.begin(), end,
                     [](const Event& event) { return event.kind == EventKind::Undone; });
}

}  // namespace carpus::simulation
