// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The configurations of marching cubes up to symmetry, as figure 3.5 of the thesis [yaacoub2008]
// shows them, with the triangles of our own table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace carpus::figures {

/// One bit set of inside corners (corner c at (c & 1, c >> 1 & 1, c >> 2 & 1)) for each class of
/// the 256 under the cube's 24 rotations and the exchange of inside and outside: the least of the
/// class's members with the fewest inside corners. Fifteen [lorensen1987marching].
[[nodiscard]] std::vector<std::uint8_t> base_cube_cases();

/// SVG: each with its inside corners as dots and its triangles, in rows of five.
[[nodiscard]] std::string draw_cube_cases();

}  // namespace carpus::figures
