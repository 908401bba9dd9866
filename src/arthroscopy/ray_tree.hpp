// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether a straight line of sight meets a surface, through a tree of boxes.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::arthroscopy {

/// Whether the segment meets the triangle, from either side. Source: [moller1997fast].
[[nodiscard]] bool meets(const Vec3& from,
                         const Vec3& to,
                         const Vec3& a,
                         const Vec3& b,
                         const Vec3& c) noexcept;

/// Holds copies of the triangles; queries are const and allocate nothing.
class RayTree {
 public:
  explicit RayTree(const TriangleMesh& mesh);

  /// Whether any triangle lies across the way between the two points.
  [[nodiscard]] bool is_between(const Vec3& from, const Vec3& to) const noexcept;

 private:
  struct Slot {
    Vec3 a;
    Vec3 b;
    Vec3 c;
  };
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: first slot; inner: right child (the left one follows)
    std::uint32_t count = 0;  ///< leaf: number of slots; inner: 0
  };
  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<Slot> slots_;
};

}  // namespace carpus::arthroscopy
