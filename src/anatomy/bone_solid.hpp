// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A bone as a solid, whole or in fragments: the fragments as they lie, with the gap between them
// closed, because a nonunion is still one bone to the surgeon who puts a screw through it.
// The gap is closed by a morphological closing (dilation, then erosion, by a ball) of the voxelised
// fragments [serra1982morphology]; distances by the transform of [felzenszwalb2012distance].
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/mesh_in.hpp"

namespace carpus {

/// Part of a line that lies inside a body: positions along the line's direction [mm].
struct LineInterval {
  double enter_mm = 0.0;
  double leave_mm = 0.0;
};

/// Intervals without allocation; a line meets no bone more often.
struct LineIntervals {
  static constexpr std::size_t kMost = 32;
  std::array<LineInterval, kMost> intervals{};
  std::size_t count = 0;

  void add(const LineInterval& interval) noexcept {
    if (count < kMost) intervals[count++] = interval;
  }
  [[nodiscard]] std::span<const LineInterval> all() const noexcept {
    return {intervals.data(), count};
  }
};

/// Fragments, and the space between them where it is at most this wide [mm], count as inside: a
/// waist nonunion of 1.5 to 2.5 mm with its rough faces, and the voxels that segmentation loses.
inline constexpr double kBridgedGapMm = 4.0;

/// A sample of a bone's outer surface.
struct OuterPoint {
  Vec3 point;
  double area_mm2 = 0.0;  ///< of the surface that it stands for
};

/// Where a plane cuts a bone.
struct BoneSection {
  double area_mm2 = 0.0;  ///< 0: it cuts nothing there
  Vec3 centroid;
};

/// A bone from the surfaces of its fragments. Built once (about 0.1 s); queries do not allocate but
/// where they return a vector.
class BoneSolid {
 public:
  /// @param fragments  closed outward surfaces [mm], at least one, not empty.
  /// @throws InvalidInput when there is nothing to build from.
  explicit BoneSolid(std::span<const MeshIn<frame::Bone>* const> fragments);

  /// True inside a fragment or the bridged gap; exact to about half a voxel (0.2 mm).
  [[nodiscard]] bool contains(const Vec3& point) const noexcept;

  /// Samples of the outer surface, at most 0.5 mm apart; fracture faces are left out.
  [[nodiscard]] const std::vector<OuterPoint>& outer_points() const noexcept {
    return outer_points_;
  }

  /// The parts of the line `point + t * direction` (unit vector) inside the bone, gaps bridged,
  /// ascending; ends are exact intersections with the surfaces.
  [[nodiscard]] std::vector<LineInterval> intervals_along(const Vec3& point,
                                                          const Vec3& direction) const;

  /// The interval of intervals_along that holds t = 0, or the nearest one; empty when the line
  /// misses the bone.
  [[nodiscard]] std::optional<LineInterval> chord_through(const Vec3& point,
                                                          const Vec3& direction) const noexcept;

  /// How far the line from `point` along `direction` (unit vector) runs before it leaves the bone,
  /// gaps bridged [mm]: the end of chord_through, 0 where there is none. No allocation; one pass
  /// over the surface. A line that crosses it more than 64 times is followed that far.
  [[nodiscard]] double way_inside_mm(const Vec3& point, const Vec3& direction) const noexcept;

  /// True inside a fragment's surface, decided by its triangles, or in the bridged gap.
  [[nodiscard]] bool encloses(const Vec3& point) const noexcept;

  [[nodiscard]] bool is_whole() const noexcept { return fragments_.size() == 1; }

  /// The fragments' facets without fracture faces, in one.
  [[nodiscard]] const TriangleMesh& outer_surface() const noexcept { return outer_surface_; }

  /// The section with the plane through `point` perpendicular to `normal` (unit vector): its part
  /// around the point. Of a whole bone from its triangles, of a broken one by voxels, gap included;
  /// then it is empty where the point is outside.
  [[nodiscard]] BoneSection section_at(const Vec3& point, const Vec3& normal) const;

 private:
  [[nodiscard]] BoneSection section_with_gap(const Vec3& point, const Vec3& normal) const;
  [[nodiscard]] LineIntervals merged_intervals(const Vec3& point,
                                               const Vec3& direction) const noexcept;

  std::vector<TriangleMesh> fragments_;
  Grid<std::uint8_t> closed_;  ///< 1 inside
  std::vector<OuterPoint> outer_points_;
  TriangleMesh outer_surface_;
};

}  // namespace carpus
