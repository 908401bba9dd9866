// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact with the triangles themselves, the slow way: what fast answers are measured against.
// Nothing here is for the 1 kHz thread.
#pragma once

#include <array>

#include "fields/triangle_tree.hpp"
#include "geometry/instrument_shape.hpp"
#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::fields {

/// Smallest distance between the segment a-b and the triangle [mm]; 0 where they meet.
/// Source: [ericson2004realtime] §5.1.9, §5.1.10.
[[nodiscard]] double segment_triangle_distance(const Vec3& a,
                                               const Vec3& b,
                                               const std::array<Vec3, 3>& triangle) noexcept;

class ExactSurface {
 public:
  /// @throws InvalidInput if the surface is not closed and consistently oriented.
  explicit ExactSurface(const TriangleMesh& surface);

  [[nodiscard]] const TriangleMesh& surface() const noexcept { return surface_; }
  [[nodiscard]] const TriangleTree& tree() const noexcept { return tree_; }

  /// Negative inside, by the sum of all facets' solid angles (the winding number) [mm].
  /// Cost: O(facets).
  [[nodiscard]] double signed_distance(const Vec3& point) const;

  /// The smallest of distance(centre) - radius over all balls of a shape: the gap of the true
  /// surface, negative for the depth. Found by cutting the axis in pieces whose lower bound (the
  /// distance changes by no more than the way [piyavskii1972]) may still be smaller.
  struct Gap {
    double gap_mm = 0;  ///< at most `tolerance_mm` above the smallest
    double z_mm = 0;    ///< centre of that ball in frame Tool
  };
  [[nodiscard]] Gap gap_of(const InstrumentShape& shape,
                           const Pose<frame::Bone, frame::Tool>& bone_from_tool,
                           double tolerance_mm = 1e-3) const;

  /// Smallest distance of a segment to the surface, by all triangles [mm].
  [[nodiscard]] double distance_to_segment(const Vec3& a, const Vec3& b) const noexcept;

 private:
  [[nodiscard]] bool is_inside(const Vec3& point) const;

  TriangleMesh surface_;
  TriangleTree tree_;
};

}  // namespace carpus::fields
