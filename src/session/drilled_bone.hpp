// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Holes in a bone as fluoroscopy takes them: the share of each small voxel that is gone.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// Shares 0 to 255 of the union of round, tapered ways, on a grid around them, 0.4 mm a voxel and
/// 27 samples in each; empty for no way. Frame Bone. @param tracks  of one body.
[[nodiscard]] Grid<std::uint8_t> removed_share(std::span<const simulation::TrackView> tracks);

}  // namespace carpus::session
