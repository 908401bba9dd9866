// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Nearest point of a triangle surface, through a tree of boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::fields {

/// The point of the triangle a, b, c nearest to p. Source: [ericson2004realtime] §5.1.5.
[[nodiscard]] Vec3 nearest_point_on_triangle(const Vec3& p,
                                             const Vec3& a,
                                             const Vec3& b,
                                             const Vec3& c) noexcept;

/// A point on the surface.
struct NearestPoint {
  Vec3 point;                   ///< in the mesh's frame [mm]
  double squared_distance = 0;  ///< to the query [mm^2]
  std::uint32_t facet = 0;      ///< of the mesh
};

/// Boxes over the facets of a mesh, split at the median of the longest side. Holds copies of the
/// triangles; queries are const, allocate nothing and may run at the same time.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  /// The nearest point within `limit_mm` of p; empty if there is none (or the mesh has no facets).
  /// `hint`, a facet that is probably near, makes it faster and never changes the distance.
  [[nodiscard]] std::optional<NearestPoint> nearest(
      const Vec3& p,
      double limit_mm = std::numeric_limits<double>::infinity(),
      std::optional<std::uint32_t> hint = std::nullopt) const noexcept;

 private:
  static constexpr std::uint32_t kLeafSize = 4;
  static constexpr std::size_t kMaxDepth = 64;  ///< halving 2^32 facets takes 32 levels

  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: first slot; inner: right child (the left one follows)
    std::uint32_t count = 0;  ///< leaf: number of slots; inner: 0
  };
  struct Slot {
    Vec3 a;
    Vec3 b;
    Vec3 c;
    std::uint32_t facet = 0;
  };

  void build(std::uint32_t begin, std::uint32_t end);
  void visit_leaf(const Node& leaf, const Vec3& p, NearestPoint& best) const noexcept;
  static void improve(const Slot& slot, const Vec3& p, NearestPoint& best) noexcept;

  std::vector<Node> nodes_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> slot_of_facet_;
};

}  // namespace carpus::fields
