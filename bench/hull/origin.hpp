// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a set's points come from, and whether it is what its name says.
#pragma once

#include <cstddef>
#include <string>

namespace carpus::bench {

struct Origin {
  std::string source;              ///< "ulna.ply"; empty for random points
  bool is_stand_in = false;        ///< another bone than its name says, or not of the folder asked
  std::size_t surface_facets = 0;  ///< of the mesh whose vertices they are; 0: not known
  std::size_t thesis_points = 0;   ///< vertices of the thesis's bone; 0: the thesis has none
};

/// Within the few per cent that simplification and marching cubes leave.
[[nodiscard]] bool has_thesis_count(const Origin& origin, std::size_t points);

/// What a reader must know of a row: "ulna.ply stands for it, 4502 vertices for the thesis's
/// 27342". Empty where it is what it says.
[[nodiscard]] std::string note_on(const Origin& origin, std::size_t points);

}  // namespace carpus::bench
