// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A sheet with thickness, and the closed body that it makes beside the bones.
#pragma once

#include <optional>

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
  struct Near {
    Vec3 point;          ///< of the sheet's middle
    double away_mm = 0;  ///< from it
    double half_mm = 0;  ///< of the thickness there
    std::uint32_t facet = 0;
  };
  /// Empty where the thickened sheet is farther than the limit.
  [[nodiscard]] std::optional<Near> nearest(const Vec3& point, double limit_mm) const;

  /// Negative inside; `limit_mm` where it is farther.
  [[nodiscard]] double mm(const Vec3& point, double limit_mm) const;
  [[nodiscard]] const Aabb& box() const noexcept { return box_; }
  [[nodiscard]] const Sheet& sheet() const noexcept { return sheet_; }

 private:
  Sheet sheet_;
  fields::TriangleTree tree_;
  double thickest_half_ = 0;
  Aabb box_;
};

struct SheetBody {
  TriangleMesh body;        ///< closed; empty where bones leave no room
  double thickness_mm = 0;  ///< median, across the sheet where its middle is its own
  double own_share = 0;     ///< of the sheet, that no other has
};

/// The bones, and sheets that keep their room.
struct Kept {
  const Surroundings* bones = nullptr;
  std::vector<const SheetDistance*> sheets;

  /// To the nearest of them; at most about a mm.
  [[nodiscard]] double near_mm(const Vec3& point) const;
  /// The point moved out of all of them, of bones exactly.
  [[nodiscard]] Vec3 out_of(Vec3 point, double room_mm) const;
};

/// The thickened sheet less what is kept.
[[nodiscard]] SheetBody body_of(const SheetDistance& distance, const Kept& kept);

/// The surface where values pass 0, outward to higher ones: the largest piece of it, smoothed,
/// simplified, and no vertex in what is kept.
[[nodiscard]] TriangleMesh smooth_surface(const Grid<float>& values,
                                          const Kept& kept,
                                          double simplify_mm);

/// A grid about the box.
[[nodiscard]] GridGeometry grid_about(const Aabb& box, double voxel_mm);

}  // namespace carpus::soft_tissue::detail
