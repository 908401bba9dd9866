// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One convex instrument against the hulls of all bones: boxes first, then the linear program, with
// the state of every pair kept from tick to tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/lp/lp_collision.hpp"
#include "geometry/aabb.hpp"
#include "geometry/convex_polytope.hpp"
#include "geometry/pose.hpp"

namespace carpus::collision {

/// Most facets and vertices of an instrument's hull; its rows are moved at every query.
inline constexpr std::size_t kMaxToolFacets = 128;

/// Do the instrument's hull and a bone's hull meet? Both are closed: touching is contact. Answers
/// are exact up to kContactToleranceMm, in favour of contact.
struct HullContact {
  LpStatus status = LpStatus::PivotLimit;  ///< PivotLimit: not known (or the pose
  ///< is not finite); take the last safe answer
  bool decided_by_boxes = false;   ///< infeasible because the boxes are apart
  bool decided_by_memory = false;  ///< infeasible by the four rows of the last query
  std::int32_t pivots = 0;
  Point<frame::Bone> common_point;             ///< with Feasible
  Direction<frame::Bone> separating_normal{};  ///< with Infeasible: unit, from the bone towards the
                                               ///< instrument
  [[nodiscard]] bool has_contact() const noexcept { return status == LpStatus::Feasible; }
};

/// Sums over all queries since the start.
struct HullColliderCounts {
  std::uint64_t queries = 0;
  std::uint64_t decided_by_boxes = 0;
  std::uint64_t decided_by_memory = 0;
  std::uint64_t pivots = 0;
  std::uint64_t restarts = 0;
  std::uint64_t pivot_limits = 0;  ///< should stay 0
  std::uint64_t not_finite = 0;    ///< poses with NaN or infinity; answered PivotLimit
};

class HullCollider {
 public:
  /// @param bones  hulls in their own frames [mm], closed, with planes (hull/quickhull.hpp).
  /// @param tool  the instrument in frame Tool, at most kMaxToolFacets facets.
  /// @throws InvalidInput if a hull is empty or the tool has too many facets.
  HullCollider(std::span<const ConvexPolytope> bones,
               const ConvexPolytope& tool,
               LpObjective objective = LpObjective::FollowBasis);

  [[nodiscard]] std::size_t bone_count() const noexcept { return bones_.size(); }

  /// Real-time: noexcept, no allocation, bounded by kMaxLpPivots scans of the bone's facets.
  /// Queries change what is kept for the pair, never the answer beyond the tolerance.
  [[nodiscard]] HullContact query(std::size_t bone,
                                  const Pose<frame::Bone, frame::Tool>& bone_from_tool) noexcept;

  /// Forgets what earlier queries left, for answers that depend on the pose alone to the last bit.
  void forget() noexcept;

  [[nodiscard]] const HullColliderCounts& counts() const noexcept { return counts_; }

 private:
  struct BoneState {
    RowArrays rows;
    Aabb box;
    LpMemory memory;
  };

  std::vector<BoneState> bones_;
  std::vector<Vec3> tool_vertices_;
  std::vector<Plane> tool_planes_;
  std::array<Plane, kMaxToolFacets> moved_planes_{};
  LpObjective objective_;
  HullColliderCounts counts_;
};

/// Corner points of a wire or pin in frame Tool: a prism of `sides` sides about +z, from the tip at
/// the origin to `length_mm`, with a pyramid of `tip_mm` at its end. The prism encloses the round
/// wire (its faces touch it). For hull::build_convex_hull. Set-up only: uses sin and cos.
struct WireShape {
  double radius_mm = 0.57;
  double length_mm = 150.0;
  double tip_mm = 2.0;
  int sides = 8;
};
[[nodiscard]] std::vector<Vec3> wire_corners(const WireShape& shape);

}  // namespace carpus::collision
