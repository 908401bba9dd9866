// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/merged_faces.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/check.hpp"
#include "geometry/predicates.hpp"

namespace carpus::hull {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

bool is_coplanar(const ConvexPolytope& p, std::uint32_t f, std::uint32_t g) {
  const Triangle& t = p.facets[f];
  return std::all_of(p.facets[g].begin(), p.facets[g].end(), [&](std::uint32_t v) {
    return v == t[0] || v == t[1] || v == t[2] ||
           orient3d(p.vertices[t[0]], p.vertices[t[1]], p.vertices[t[2]], p.vertices[v]) == 0;
  });
}

/// Face number of each facet, and the faces with their facets.
std::vector<std::uint32_t> gather(const ConvexPolytope& p, std::vector<PolygonalFace>& faces) {
  std::vector<std::uint32_t> face(p.facets.size(), kNone);
  for (std::uint32_t seed = 0; seed < p.facets.size(); ++seed) {
    if (face[seed] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(faces.size());
    std::vector<std::uint32_t> members{seed};
    face[seed] = number;
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (const std::uint32_t g : p.neighbours[members[i]]) {
        if (face[g] != kNone || !is_coplanar(p, seed, g)) continue;
        face[g] = number;
        members.push_back(g);
      }
    }
    std::sort(members.begin(), members.end());
    faces.push_back({{}, {}, std::move(members)});
  }
  return face;
}

/// Follows the border, turning about each corner through the face's own facets.
void walk_border(const ConvexPolytope& p,
                 const std::vector<std::uint32_t>& face,
                 std::uint32_t number,
                 PolygonalFace& polygon) {
  const auto is_border = [&](std::uint32_t f, std::size_t e) {
    return face[p.neighbours[f][e]] != number;
  };
  std::uint32_t f = kNone;
  std::size_t e = 0;
  for (const std::uint32_t g : polygon.facets) {
    for (std::size_t i = 0; i < 3 && f == kNone; ++i) {
      if (!is_border(g, i)) continue;
      f = g;
      e = i;
    }
  }
  CARPUS_CHECK(f != kNone);
  const std::uint32_t first = p.facets[f][e];
  do {
    polygon.corners.push_back(p.facets[f][e]);
    polygon.neighbours.push_back(face[p.neighbours[f][e]]);
    const std::uint32_t corner = p.facets[f][(e + 1) % 3];
    e = (e + 1) % 3;
    while (!is_border(f, e)) {
      f = p.neighbours[f][e];
      const Triangle& t = p.facets[f];
      e = t[0] == corner ? 0 : (t[1] == corner ? 1 : 2);
    }
  } while (p.facets[f][e] != first);
}

}  // namespace

std::vector<PolygonalFace> merged_faces(const ConvexPolytope& polytope) {
  std::vector<PolygonalFace> faces;
  const std::vector<std::uint32_t> face = gather(polytope, faces);
  for (std::uint32_t i = 0; i < faces.size(); ++i) walk_border(polytope, face, i, faces[i]);
  return faces;
}

}  // namespace carpus::hull
