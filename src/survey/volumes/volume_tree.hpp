// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A binary tree of bounding volumes over the triangles of a surface, convex or not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "convex/convex_body.hpp"
#include "geometry/triangle_mesh.hpp"
#include "survey/volumes/axis_box.hpp"
#include "survey/volumes/k_dop.hpp"
#include "survey/volumes/oriented_box.hpp"
#include "survey/volumes/triangle_contact.hpp"

namespace carpus::survey {

/// Built once in the surface's own frame; one triangle in each leaf. Nodes are split across the
/// axis on which the triangles' centres vary most, at their mean as in [klosowski1998efficient]
/// §3.3 and [gottschalk1996separating] §4, at the median where the mean would leave fewer than a
/// quarter on a side: so that no path is longer than kMaxDepth. `Volume` is AxisBox, OrientedBox or
/// KDop<6, 14, 18, 26>.
template <typename Volume>
class VolumeTree {
 public:
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 24U;

  struct Node {
    Volume volume;
    std::uint32_t first = 0;  ///< inner: left child, the right one follows; leaf: triangle
    bool is_leaf = false;
    double size = 0;
  };

  /// Needs no manifold: any triangles, without area too. An empty surface touches nothing.
  /// @throws InvalidInput for a corner that is not finite, beyond kLargestCoordinate or not there,
  /// or too many triangles.
  explicit VolumeTree(const TriangleMesh& surface);
  explicit VolumeTree(const convex::ConvexBody& body) : VolumeTree(body.polytope().surface()) {}

  [[nodiscard]] const std::vector<Node>& nodes() const noexcept { return nodes_; }
  [[nodiscard]] const TrianglePoints& triangle(std::uint32_t index) const noexcept {
    return triangles_[index];
  }
  /// Of the surface as given.
  [[nodiscard]] std::uint32_t facet(std::uint32_t index) const noexcept { return facets_[index]; }
  /// Levels below the root.
  [[nodiscard]] std::size_t depth() const noexcept { return depth_; }
  /// Largest |x| + |y| + |z| of a corner [mm].
  [[nodiscard]] double size_mm() const noexcept { return size_mm_; }

 private:
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::size_t level);
  [[nodiscard]] std::uint32_t split(std::uint32_t begin, std::uint32_t end);

  std::vector<Node> nodes_;
  std::vector<TrianglePoints> triangles_;
  std::vector<std::uint32_t> facets_;
  std::size_t depth_ = 0;
  double size_mm_ = 0;
};

extern template class VolumeTree<AxisBox>;
extern template class VolumeTree<OrientedBox>;
extern template class VolumeTree<KDop<6>>;
extern template class VolumeTree<KDop<14>>;
extern template class VolumeTree<KDop<18>>;
extern template class VolumeTree<KDop<26>>;

}  // namespace carpus::survey
