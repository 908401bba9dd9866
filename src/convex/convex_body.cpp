// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/convex_body.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "hull/polytope_measures.hpp"

namespace carpus::convex {

ConvexBody::ConvexBody(ConvexPolytope polytope) : polytope_(std::move(polytope)) {
  if (polytope_.facets.empty()) {
    throw InvalidInput("a convex body needs a hull with facets, and this one has none");
  }
  faces_ = hull::merged_faces(polytope_);
  interior_point_ = hull::measures_of(polytope_).centroid;
  for (const Vec3& v : polytope_.vertices) {
    box_.include(v);
    for (const double c : {v.x, v.y, v.z}) {
      largest_coordinate_mm_ = std::max(largest_coordinate_mm_, std::abs(c));
    }
    radius_mm_ = std::max(radius_mm_, distance(v, interior_point_));
  }
  radius_mm_ *= 1 + 8 * std::numeric_limits<double>::epsilon();

  // About each vertex: an edge's left face has, before the vertex, the next edge's other end.
  struct Spoke {
    std::uint32_t end;   // of the edge that leaves the vertex
    std::uint32_t next;  // end of the next edge counter-clockwise about the vertex
    std::uint32_t face;  // between the two
  };
  std::vector<std::vector<Spoke>> spokes(polytope_.vertices.size());
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const std::vector<std::uint32_t>& corners = faces_[f].corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t n = corners.size();
      spokes[corners[i]].push_back({corners[(i + 1) % n], corners[(i + n - 1) % n], f});
    }
  }
  neighbour_starts_.push_back(0);
  for (const std::vector<Spoke>& around : spokes) {
    std::size_t at = 0;
    for (std::size_t turn = 0; turn < around.size(); ++turn) {
      neighbours_.push_back(around[at].end);
      around_.push_back(around[at].face);
      const auto next = std::find_if(around.begin(), around.end(),
                                     [&](const Spoke& s) { return s.end == around[at].next; });
      at = static_cast<std::size_t>(next - around.begin());
    }
    neighbour_starts_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }
}

}  // namespace carpus::convex
