// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The skin, for the eye and for portals.
#pragma once

#include "geometry/grid.hpp"
#include "geometry/mesh_in.hpp"

namespace carpus::reconstruct {

/// Surface between air and body at -480 HU, smoothed to about 1 mm and reduced to at most 12000
/// facets [Patient, mm]; the largest piece. Open where the limb leaves the volume. Empty where
/// there is no such surface.
[[nodiscard]] MeshIn<frame::Patient> build_skin_surface(const GridView<const std::int16_t>& ct);

/// The skin for the eye: cut by planes a little inside the volume's faces, where the limb leaves it
/// as a straight edge instead of the ragged rims of the removed caps; the largest piece of that.
/// @param volume  of the CT from which the skin was built, in the same frame.
[[nodiscard]] MeshIn<frame::Patient> trimmed_skin(const MeshIn<frame::Patient>& skin,
                                                  const GridGeometry& volume);

}  // namespace carpus::reconstruct
