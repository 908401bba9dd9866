// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fewer triangles of a surface that is drawn in several states, such as a joint's wall before and
// after the joint is pulled open: what is nearly flat in one may be a fold in another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

struct InStates {
  std::vector<std::uint32_t> kept;  ///< vertices of the input, rising
  std::vector<Triangle> facets;     ///< by the places of their vertices in `kept`
  double error_mm = 0.0;            ///< the greatest of what was done, by the quadric metric
};

/// Collapses edges onto one of their ends [garland1997surface] until so few facets are left. A
/// collapse costs the greatest of its errors over the states, so that the error holds in each; none
/// is done that would turn a facet over in any state, or take a closed, oriented 2-manifold out of
/// the manifolds. Where no other is left the result has more facets than asked for.
///
/// @param states  of each the vertices' places, one entry a vertex [mm]; at least one state.
/// @throws InvalidInput if there is none, or they differ in length.
[[nodiscard]] InStates simplify_in_states(const std::vector<Triangle>& facets,
                                          std::span<const std::vector<Vec3>> states,
                                          std::size_t target_facets);

}  // namespace carpus::mesh
