// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/neighbours.hpp"

#include <numeric>

namespace carpus::mesh {

Neighbours::Neighbours(const TriangleMesh& mesh)
    : first_(mesh.vertices.size() + 1), list_(mesh.facets.size() * 3) {
  for (const Triangle& t : mesh.facets) {
    for (const std::uint32_t v : t) ++first_[v + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const Triangle& t : mesh.facets) {
    for (std::size_t i = 0; i < 3; ++i) list_[next[t[i]]++] = t[(i + 1) % 3];
  }
}

}  // namespace carpus::mesh
