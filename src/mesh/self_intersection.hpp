// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a surface passes through itself, as smoothing and simplification of thin places may make
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// Pairs of facets that cross: an edge of one passes through the inside of the other. What only
/// touches, or lies in one plane, is no crossing; facets that share an edge cannot cross, of those
/// that share a corner the edges opposite it are looked at. Signs are exact
/// (geometry/predicates.hpp); candidates come from a grid of cells, so that the cost is about O(n).
/// @pre every vertex is finite, every facet's indices lie within the vertices
[[nodiscard]] std::size_t count_self_intersections(const TriangleMesh& mesh);

/// The facets of those pairs, each once, rising.
[[nodiscard]] std::vector<std::uint32_t> crossing_facets(const TriangleMesh& mesh);

}  // namespace carpus::mesh
