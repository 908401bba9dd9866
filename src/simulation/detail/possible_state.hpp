// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a state that was read from bytes is one that ticks could have left: a keyframe comes from
// a file, and its checksum is made by whoever made the file.
#pragma once

#include <cstddef>
#include <span>

#include "anatomy/hand_pose.hpp"
#include "procedure/situation.hpp"
#include "simulation/detail/bodies.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

/// What a state is held against.
struct StateBounds {
  std::size_t bodies = 0;
  std::size_t instruments = 0;
  std::size_t steps = 0;
  anatomy::HandLimits wrist;
  std::span<const Vec3> centres;  ///< of the bodies' surfaces, frame Bone
  BodySet fragments = 0;          ///< that can be pushed out of their place
  BodySet target = 0;             ///< that can be carried along by what it is pinned to
};

/// Every index names something, both ends of a relation agree, directions are of unit length, and
/// no number is beyond what a tick would have let in. Not whether these inputs lead there: only
/// stepping them tells.
[[nodiscard]] bool is_possible(const Operated& now,
                               const Spent& spent,
                               const StateBounds& bounds) noexcept;

/// The shots on record: in order, none later than now, adding up to what was spent.
[[nodiscard]] bool are_possible(std::span<const procedure::Shot> shots,
                                const Spent& spent) noexcept;

}  // namespace carpus::simulation::detail
