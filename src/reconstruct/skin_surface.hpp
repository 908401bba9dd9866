// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The skin, for the eye and for portals.
#pragma once

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::reconstruct {

/// Surface between air and body at -480 HU, smoothed to about 1 mm and reduced to at most 12000
/// facets [Patient, mm]; the largest piece. Open where the limb leaves the volume. Empty where
/// there is no such surface.
[[nodiscard]] TriangleMesh build_skin_surface(const GridView<const std::int16_t>& ct);

}  // namespace carpus::reconstruct
