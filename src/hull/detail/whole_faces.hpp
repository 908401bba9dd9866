// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The final triangles of a grown hull: those that are alone in their plane as they are, the others
// merged to faces and triangulated anew over the faces' corners.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hull/detail/hull_facet.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

struct FinalFacet {
  Triangle corners;                         ///< indices into GrownHull::vertices
  std::array<std::uint32_t, 3> neighbours;  ///< [edge (i, i + 1)]: index of the facet across
};

/// Each face is fanned from the corner that is first in the input.
[[nodiscard]] std::vector<FinalFacet> whole_faces(const GrownHull& hull,
                                                  HullStatistics& statistics);

}  // namespace carpus::hull
