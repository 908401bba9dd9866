// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. On each face of the cube, every run of inside corners is cut off by one directed segment: on
//    an ambiguous face (two inside corners across the diagonal) the inside corners stay apart. The
//    rule sees only the four corners of the face, so both neighbours draw the same segments.
// 2. Each crossed edge starts one segment and ends one, so segments join into closed loops.
// 3. Each loop is triangulated without a diagonal that lies in a face of the cube: the neighbour
//    might draw the same line, and an edge would have four triangles. Where no such triangulation
//    exists, a vertex in the loop's middle is added.
// Hence each edge has two triangles and each vertex one fan, whatever the values.
#include "mesh/cube_table.hpp"

#include <cstddef>

namespace carpus::mesh {
namespace {

using Loop = std::vector<std::uint8_t>;

/// Corners of the faces, counter-clockwise seen from outside the cube.
constexpr std::array<std::array<std::uint8_t, 4>, 6> kFaces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

std::uint8_t edge_between(std::uint8_t a, std::uint8_t b) {
  for (std::size_t e = 0; e < kCubeEdges.size(); ++e) {
    const CubeEdge& edge = kCubeEdges[e];
    if ((edge.low_corner == a && edge.high_corner == b) ||
        (edge.low_corner == b && edge.high_corner == a)) {
      return static_cast<std::uint8_t>(e);
    }
  }
  return 0xFF;
}

bool share_a_face(std::uint8_t e, std::uint8_t f) {
  const auto corners = [](std::uint8_t i) {
    return static_cast<unsigned>(kCubeEdges[i].low_corner) |
           (static_cast<unsigned>(kCubeEdges[i].high_corner) << 4U);
  };
  const unsigned all = corners(e);
  const unsigned other = corners(f);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const unsigned bits = (all >> axis & 1U) + (all >> (axis + 4U) & 1U) + (other >> axis & 1U) +
                          (other >> (axis + 4U) & 1U);
    if (bits == 0 || bits == 4) return true;
  }
  return false;
}

/// next[e] is where the segment that starts on edge e ends.
std::array<std::uint8_t, 12> segments_of(unsigned inside) {
  std::array<std::uint8_t, 12> next;
  next.fill(0xFF);
  const auto is_inside = [&](std::uint8_t corner) { return (inside >> corner & 1U) != 0; };
  for (const auto& face : kFaces) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_inside(face[i]) || !is_inside(face[(i + 1) % 4])) continue;
      std::size_t last = (i + 1) % 4;  // walk to the end of the run of inside corners
      while (is_inside(face[(last + 1) % 4])) last = (last + 1) % 4;
      next[edge_between(face[i], face[(i + 1) % 4])] =
          edge_between(face[last], face[(last + 1) % 4]);
    }
  }
  return next;
}

/// Triangulates corners first..last of the loop; false when a diagonal in a face cannot be avoided.
bool triangulate(const Loop& loop, std::size_t first, std::size_t last, CubeCase& out) {
  if (last - first < 2) return true;
  const auto is_allowed = [&](std::size_t i, std::size_t j) {
    const bool is_side = j - i == 1 || (i == 0 && j + 1 == loop.size());
    return is_side || !share_a_face(loop[i], loop[j]);
  };
  for (std::size_t middle = first + 1; middle < last; ++middle) {
    if (!is_allowed(first, middle) || !is_allowed(middle, last)) continue;
    const std::size_t before = out.triangles.size();
    out.triangles.push_back({loop[first], loop[middle], loop[last]});
    if (triangulate(loop, first, middle, out) && triangulate(loop, middle, last, out)) return true;
    out.triangles.resize(before);
  }
  return false;
}

CubeCase case_of(unsigned inside) {
  CubeCase result;
  std::array<std::uint8_t, 12> next = segments_of(inside);
  for (std::uint8_t start = 0; start < 12; ++start) {
    Loop loop;
    for (std::uint8_t e = start; next[e] != 0xFF;) {
      loop.push_back(e);
      const std::uint8_t following = next[e];
      next[e] = 0xFF;
      e = following;
    }
    if (loop.empty() || triangulate(loop, 0, loop.size() - 1, result)) continue;
    const auto centre = static_cast<std::uint8_t>(kFirstLoopCentre + result.centred_loops.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      result.triangles.push_back({loop[i], loop[(i + 1) % loop.size()], centre});
    }
    result.centred_loops.push_back(loop);
  }
  return result;
}

}  // namespace

const std::array<CubeCase, 256>& cube_table() {
  static const std::array<CubeCase, 256> kTable = [] {
    std::array<CubeCase, 256> cases;
    for (unsigned inside = 0; inside < 256; ++inside) cases[inside] = case_of(inside);
    return cases;
  }();
  return kTable;
}

}  // namespace carpus::mesh
