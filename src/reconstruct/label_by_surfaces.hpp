// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A label volume that agrees with the bones' surfaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::reconstruct {

/// A voxel gets the bone inside whose surface [Patient, mm] its centre lies, or 0. Where two claim
/// it, the one stays that has it already, or else the first. What a bone has apart from its surface
/// (a surface is of one piece) stays its own, for a person to decide.
/// @param label_of  each surface's label, below 256
void label_by_surfaces(const std::vector<const TriangleMesh*>& surfaces,
                       std::span<const std::uint8_t> label_of,
                       const GridView<std::uint8_t>& labels);

}  // namespace carpus::reconstruct
