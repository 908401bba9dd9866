// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which vertices share an edge with a vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// Of a closed, oriented mesh, in which the edges that leave a vertex reach each neighbour once.
class Neighbours {
 public:
  explicit Neighbours(const TriangleMesh& mesh);

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t vertex) const noexcept {
    return std::span(list_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

 private:
  std::vector<std::size_t> first_;  ///< of vertex v: [first[v], first[v + 1])
  std::vector<std::uint32_t> list_;
};

}  // namespace carpus::mesh
