// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where two sides of a closed surface touch as scanned, it has bridges between them; moved apart,
// each would be drawn out to a peg. They are cut through, and both ends closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// A vertex on a cut, on the edge from `a` to `b` of the input.
struct CutVertex {
  std::uint32_t a = 0;  ///< on the side where this vertex lies
  std::uint32_t b = 0;  ///< on the other
  double share = 0;     ///< a + share (b - a)
};

struct PartedBridges {
  std::vector<Triangle>
      facets;  ///< the input's vertices keep their numbers, those of `cuts` follow
  std::vector<CutVertex> cuts;
  std::size_t bridges = 0;  ///< how many were cut
};

/// @param vertices  in any one frame [mm]
/// @param facets  of a closed, oriented 2-manifold
/// @param level   by vertex: of one side below 0.5, of the other above
/// @param spans   whether a vertex is of what truly goes across; a bridge that is mostly of such
/// stays.
///
/// A bridge is what a closed curve of level 0.5 goes round, if the surface stays in one piece when
/// cut along it, and it is not the longest curve: that one is the rim of both sides. Its ends are
/// closed by the triangulation of least area [barequet1995filling]; one of more than 600 edges
/// stays as it is.
/// @throws InvalidInput if `level` and `vertices` differ in length.
[[nodiscard]] PartedBridges part_bridges(std::span<const Vec3> vertices,
                                         const std::vector<Triangle>& facets,
                                         std::span<const float> level,
                                         const std::function<bool(std::uint32_t)>& spans);

}  // namespace carpus::mesh
