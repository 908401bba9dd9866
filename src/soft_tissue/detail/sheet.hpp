// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A sheet with thickness, and the closed body that it makes beside the bones.
#pragma once

#include "geometry/grid.hpp"
#include "soft_tissue/detail/surroundings.hpp"

namespace carpus::soft_tissue::detail {

struct Sheet {
  TriangleMesh middle;
  std::vector<double> half_mm;  ///< half the thickness, by vertex
};

/// Rows of equally many points, neighbours joined.
[[nodiscard]] Sheet sheet_of(const std::vector<std::vector<Vec3>>& rows,
                             const std::vector<std::vector<double>>& half_mm);

/// How far a point is from the thickened sheet.
class SheetDistance {
 public:
  explicit SheetDistance(const Sheet& sheet);
  /// Negative inside; `limit_mm` where it is farther.
  [[nodiscard]] double mm(const Vec3& point, double limit_mm) const;
  [[nodiscard]] const Aabb& box() const noexcept { return box_; }

 private:
  Sheet sheet_;
  fields::TriangleTree tree_;
  double thickest_half_ = 0;
  Aabb box_;
};

struct SheetBody {
  TriangleMesh body;        ///< closed; empty where bones leave no room
  double thickness_mm = 0;  ///< median, across the sheet
};

/// The thickened sheet less the bones.
[[nodiscard]] SheetBody body_of(const Sheet& sheet, const Surroundings& bones);

/// The surface where values pass 0, outward to higher ones: the largest piece of it, smoothed,
/// simplified, and no vertex in a bone.
[[nodiscard]] TriangleMesh smooth_surface(const Grid<float>& values,
                                          const Surroundings& bones,
                                          double simplify_mm);

/// A grid about the box.
[[nodiscard]] GridGeometry grid_about(const Aabb& box, double voxel_mm);

}  // namespace carpus::soft_tissue::detail
