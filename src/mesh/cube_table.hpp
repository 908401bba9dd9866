// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The 256 configurations of marching cubes [lorensen1987marching], made by a rule instead of typed
// in. The thesis's 15 base cases (reduced by complement) leave holes where two cubes read a shared
// ambiguous face differently; here a face is always read the same way from both sides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace carpus::mesh {

/// Corner c of a cube lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 * a + i runs along axis a
/// from the i-th corner whose bit a is 0.
struct CubeEdge {
  std::uint8_t low_corner;
  std::uint8_t high_corner;
  std::uint8_t axis;
};
inline constexpr std::array<CubeEdge, 12> kCubeEdges{{{0, 1, 0},
                                                      {2, 3, 0},
                                                      {4, 5, 0},
                                                      {6, 7, 0},
                                                      {0, 2, 1},
                                                      {1, 3, 1},
                                                      {4, 6, 1},
                                                      {5, 7, 1},
                                                      {0, 4, 2},
                                                      {1, 5, 2},
                                                      {2, 6, 2},
                                                      {3, 7, 2}}};

/// Stands for the extra vertex in the middle of a loop, in the triangles of a CubeCase.
inline constexpr std::uint8_t kFirstLoopCentre = 12;

/// The surface within one cube. Triangles name cube edges, whose crossing is their vertex, or
/// kFirstLoopCentre + i for the centre of `centred_loops[i]`.
struct CubeCase {
  std::vector<std::array<std::uint8_t, 3>> triangles;
  std::vector<std::vector<std::uint8_t>> centred_loops;
};

/// Cases by the bit set of inside corners; triangles are counter-clockwise seen from the outside
/// corners in a right-handed grid. Built once, on first use.
[[nodiscard]] const std::array<CubeCase, 256>& cube_table();

}  // namespace carpus::mesh
