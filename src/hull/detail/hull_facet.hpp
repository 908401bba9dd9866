// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A triangle of a hull under construction, shared by the steps of fast_hull.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "hull/detail/orientation.hpp"

namespace carpus::hull {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Facet and edge in one word, so that no neighbour is searched for.
constexpr std::uint32_t side(std::uint32_t facet, std::uint32_t edge) { return facet * 4 + edge; }
constexpr std::uint32_t facet_of(std::uint32_t side) { return side / 4; }
constexpr std::uint32_t edge_of(std::uint32_t side) { return side % 4; }
inline constexpr std::array<std::uint32_t, 3> kNextEdge{1, 2, 0};

struct GrowingFacet {
  OrientedPlane plane;
  Triangle corners;                     ///< indices into GrownHull::vertices
  std::array<std::uint32_t, 3> across;  ///< [edge (i, i + 1)]: side() of the neighbour
  std::uint32_t first_conflict;         ///< its points in the conflict arena
  std::uint32_t conflicts;
  std::uint32_t round;  ///< in which it was last looked at; kNone: removed
};

/// What the growing leaves: facets, among them removed ones, over vertices in order of discovery,
/// of which some may have been swallowed again or lie within a face or an edge.
struct GrownHull {
  std::vector<GrowingFacet> facets;
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> input_indices;  ///< of the vertices
};

}  // namespace carpus::hull
