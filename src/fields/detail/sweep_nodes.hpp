// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The inner loop of cutting: a swept tool's depth at all nodes of a brick.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/grid.hpp"
#include "geometry/swept_tool.hpp"
#include "geometry/vec3.hpp"

namespace carpus::fields::detail {

/// A tool made ready for a body's grid.
class SweepNodes {
 public:
  /// @param origin  node (0, 0, 0) of the cut field [mm, frame Bone].
  SweepNodes(const SweptTool& tool, const Vec3& origin, double spacing_mm) noexcept;

  /// Depth in the tool (-t) in steps of kCutUnitMm, clamped to what a node holds; the last three
  /// are uncut. A node's value does not depend on the brick that asks: neighbours agree on their
  /// border to the last bit.
  void depths(const VoxelIndex& low_node, std::array<std::int16_t, 128>& out) const noexcept;

 private:
  struct Piece {
    float from = 0, to = 0;  ///< z of its ends
    float radius = 0;        ///< at from
    float slope = 0;
    float lean = 0;  ///< from a point's z to its nearest ball's, per mm off the axis
  };
  Vec3 from_tool_;  ///< node (0, 0, 0) from the tool's origin
  double spacing_;
  std::array<float, 3> axis_{};
  std::array<Piece, 3> pieces_{};
  int count_ = 0;
};

}  // namespace carpus::fields::detail
