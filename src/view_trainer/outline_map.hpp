// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A shape on a C-arm picture and how far from its outline any place of the picture is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/predicates.hpp"

namespace carpus::view_trainer {

/// Corners in pixels of the picture: the centre of the top left one is (0, 0). Closed.
using Polygon = std::vector<Vec2>;

/// Where a map lies on the picture and how finely it is divided.
struct OutlineLattice {
  Vec2 low;  ///< middle of the first cell [pixels]
  int columns = 0;
  int rows = 0;
  double mm_per_pixel = 1.0;  ///< in the plane of the bone, not at the receptor
};

/// Cells a pixel: with pixels of 0.125 mm in the bone's plane an outline is kept to 0.03 mm.
inline constexpr int kCellsPerPixel = 2;

class OutlineMap {
 public:
  explicit OutlineMap(const OutlineLattice& lattice);

  /// Adds to the shape, before `finish`: a triangle of any orientation, a disc, the inside of a
  /// closed polygon (even-odd).
  void add_triangle(const Vec2& a, const Vec2& b, const Vec2& c);
  void add_disc(const Vec2& centre, double radius_pixels);
  void add_polygon(const Polygon& polygon);
  /// Computes the distances.
  void finish();

  [[nodiscard]] const OutlineLattice& lattice() const noexcept { return lattice_; }
  /// From the outline, negative inside the shape [mm in the bone's plane]; beyond the map that of
  /// its nearest place.
  [[nodiscard]] double distance_at(const Vec2& pixel) const noexcept;
  /// Towards outside, a unit vector.
  [[nodiscard]] Vec2 outwards_at(const Vec2& pixel) const noexcept;
  /// The greatest distance within a convex polygon: how far the polygon stands out [mm].
  [[nodiscard]] double overhang_of(const Polygon& convex) const;
  /// The outer outlines, longest first, those of specks left out.
  [[nodiscard]] std::vector<Polygon> outlines() const;

 private:
  [[nodiscard]] Vec2 cell_of(const Vec2& pixel) const noexcept {
    return {(pixel.x - lattice_.low.x) * kCellsPerPixel,
            (pixel.y - lattice_.low.y) * kCellsPerPixel};
  }
  [[nodiscard]] Vec2 pixel_of(const Vec2& cell) const noexcept {
    return {lattice_.low.x + cell.x / kCellsPerPixel, lattice_.low.y + cell.y / kCellsPerPixel};
  }
  /// Calls for each cell whose middle may lie between two corners of a box [cells].
  template <typename Visit>
  void visit_box(Vec2 low, Vec2 high, const Visit& visit) const;

  OutlineLattice lattice_;
  Grid<std::uint8_t> inside_;
  Grid<float> distance_;
};

}  // namespace carpus::view_trainer
