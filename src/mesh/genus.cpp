// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/genus.hpp"

#include <vector>

namespace carpus::mesh {

int genus_of(const TriangleMesh& mesh) {
  std::vector<char> is_used(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.facets) {
    for (const std::uint32_t v : t) is_used[v] = 1;
  }
  long vertices = 0;
  for (const char used : is_used) vertices += used;
  const long facets = static_cast<long>(mesh.facets.size());
  const long edges = facets * 3 / 2;  // closed: each edge has two facets
  return static_cast<int>((2 - (vertices - edges + facets)) / 2);
}

}  // namespace carpus::mesh
