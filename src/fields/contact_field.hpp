// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A bone's distance field as contact reads it a thousand times a second: bricks of 4 x 4 x 4 cells,
// 256 bytes each, so that a walk through the field stays in few cache lines; only those that the
// band meets; and with what the samples are worth.
//
// What a sample is worth. The nodes hold the exact distance d of a closed surface, clamped to
// +-band. Let f(p) be the trilinear value at p, w_i the weights of the cell's nodes x_i, h the
// spacing, t the place in the cell (0 to 1 by axis) and V(p) = h^2 sum t_a (1 - t_a) <= 3 h^2 / 4.
//  (1) d changes by no more than the way, so |f - d| <= sum w_i |d(x_i) - d(p)|
//      <= sum w_i |x_i - p| <= sqrt(sum w_i |x_i - p|^2) = sqrt(V) <= (sqrt(3) / 2) h.
//  (2) d^2 is a minimum of |p - y|^2 over points y, so d^2 - |p|^2 is concave: f^2 <= sum w_i d_i^2
//      <= d^2 + V. Where |f| > sqrt(V), (1) gives the sign too: |d| >= sqrt(f^2 - V).
// (1) is attained, where the medial axis cuts a cell; (2) is what bounds the depth of a shape whose
// axis keeps off the surface: about V / 2r. Both hold of the clamped distance as well, clamping
// keeps both properties. Nodes are rounded to band / 65534, which every bound includes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"
#include "geometry/vec3.hpp"

namespace carpus::fields {

/// sqrt(3) / 2, rounded up: the bound (1) per spacing.
inline constexpr double kFieldErrorPerSpacing = 0.86602540378443875;

/// The trilinear polynomial of one cell in its own coordinates, 0 to 1 along each axis [mm].
struct CellPolynomial {
  double one = 0, x = 0, y = 0, z = 0, xy = 0, yz = 0, xz = 0, xyz = 0;

  /// Of a cell in a cube of Nodes x Nodes x Nodes whole numbers, x fastest, from its low corner.
  template <int Nodes>
  [[nodiscard]] static CellPolynomial of_nodes(const std::int16_t* node, double unit) noexcept {
    constexpr std::size_t kUp = Nodes;
    constexpr std::size_t kOver = std::size_t{Nodes} * Nodes;
    // Sums of whole numbers: exact.
    const int v000 = node[0];
    const int v100 = node[1];
    const int v010 = node[kUp];
    const int v110 = node[kUp + 1];
    const int v001 = node[kOver];
    const int v101 = node[kOver + 1];
    const int v011 = node[kOver + kUp];
    const int v111 = node[kOver + kUp + 1];
    return {unit * v000,
            unit * (v100 - v000),
            unit * (v010 - v000),
            unit * (v001 - v000),
            unit * (v110 - v100 - v010 + v000),
            unit * (v011 - v010 - v001 + v000),
            unit * (v101 - v100 - v001 + v000),
            unit * (v111 - v110 - v101 - v011 + v100 + v010 + v001 - v000)};
  }

  [[nodiscard]] double value(const Vec3& t) const noexcept {
    return one + x * t.x + y * t.y + z * t.z + xy * t.x * t.y + yz * t.y * t.z + xz * t.x * t.z +
           xyz * t.x * t.y * t.z;
  }
  /// By cell coordinates: divide by the spacing for mm/mm.
  [[nodiscard]] Vec3 slope(const Vec3& t) const noexcept {
    return {x + xy * t.y + xz * t.z + xyz * t.y * t.z, y + xy * t.x + yz * t.z + xyz * t.x * t.z,
            z + yz * t.y + xz * t.x + xyz * t.x * t.y};
  }
};

class ContactField {
 public:
  /// @param field  build_distance_field's, of this surface: axes along the frame's, one spacing.
  /// @param surface  closed, in the same frame [mm].
  /// @throws InvalidInput if the grid is not such a field: turned, unequal spacing, a value not
  ///     finite or not a distance (it changes by more than the way), too small around the surface,
  ///     or far from zero at the surface's vertices.
  ContactField(const Grid<float>& field, const TriangleMesh& surface);

  [[nodiscard]] double spacing_mm() const noexcept { return spacing_; }
  /// Distances are clamped to +-band.
  [[nodiscard]] double band_mm() const noexcept { return band_; }
  /// Outside the grid, and where the field is clamped outside the bone, the distance is at least
  /// this.
  [[nodiscard]] double reach_mm() const noexcept { return reach_; }
  /// Bound (1) for any place: |sample - clamped distance| is at most this.
  [[nodiscard]] double error_mm() const noexcept { return error_; }
  /// Between neighbouring nodes the field changes by no more than this per mm; at most a little
  /// over 1. Along a direction u it changes by no more than this times |u.x| + |u.y| + |u.z|.
  [[nodiscard]] double steepest() const noexcept { return steepest_; }
  /// A lower bound of the true distance where the field says `sample`: the better of (1) and (2).
  [[nodiscard]] double lowest_distance(double sample) const noexcept;
  /// An upper bound.
  [[nodiscard]] double highest_distance(double sample) const noexcept {
    return -lowest_distance(-sample);
  }

  [[nodiscard]] const Aabb& surface_box() const noexcept { return surface_box_; }
  /// A ball around the surface.
  [[nodiscard]] const Vec3& ball_centre() const noexcept { return ball_centre_; }
  [[nodiscard]] double ball_radius_mm() const noexcept { return ball_radius_; }
  /// Memory of bricks and their table.
  [[nodiscard]] std::size_t byte_count() const noexcept;

  /// Coordinates in cells: cell (i, j, k) spans i to i + 1 and so on.
  [[nodiscard]] Vec3 cells_from_point(const Vec3& point) const noexcept {
    return (point - origin_) * per_spacing_;
  }
  [[nodiscard]] double per_spacing() const noexcept { return per_spacing_; }
  /// Node (0, 0, 0) [mm].
  [[nodiscard]] const Vec3& origin() const noexcept { return origin_; }
  /// Number of cells by axis.
  [[nodiscard]] const std::array<int, 3>& cell_count() const noexcept { return cells_; }

  /// The polynomial of a cell of the grid. False: the whole brick of 4 x 4 x 4 cells is clamped
  /// and the polynomial is the constant +-band.
  [[nodiscard]] bool load(const VoxelIndex& cell, CellPolynomial& result) const noexcept;

  /// Value at a point; +reach outside the grid. Real-time. For tests and single points.
  [[nodiscard]] double sample(const Vec3& point) const noexcept;

 private:
  static constexpr int kBrick = 4;                ///< cells along each side
  static constexpr int kBrickNodes = kBrick + 1;  ///< borders are kept twice, so that a cell's
                                                  ///< nodes lie in one brick
  static constexpr std::int32_t kFarOutside = -1;
  static constexpr std::int32_t kFarInside = -2;
  struct alignas(64) Brick {
    std::array<std::int16_t, 128> node{};  ///< x fastest; in units of unit_
  };

  void measure_grid(const Grid<float>& field, const TriangleMesh& surface);
  void fill_bricks(const Grid<float>& field);
  void check_against(const TriangleMesh& surface) const;

  double spacing_ = 0;
  double per_spacing_ = 0;
  double band_ = 0;
  double reach_ = 0;
  double error_ = 0;
  double steepest_ = 0;
  double unit_ = 0;  ///< mm of one step of a node
  Vec3 origin_;
  std::array<int, 3> cells_{};
  std::array<int, 3> bricks_by_axis_{};
  std::vector<std::int32_t> table_;
  std::vector<Brick> bricks_;
  Aabb surface_box_;
  Vec3 ball_centre_;
  double ball_radius_ = 0;
};

inline bool ContactField::load(const VoxelIndex& cell, CellPolynomial& result) const noexcept {
  const int bx = cell.x / kBrick;
  const int by = cell.y / kBrick;
  const int bz = cell.z / kBrick;
  const int brick = (bz * bricks_by_axis_[1] + by) * bricks_by_axis_[0] + bx;
  const std::int32_t at = table_[static_cast<std::size_t>(brick)];
  if (at < 0) {
    result = {};
    result.one = at == kFarOutside ? band_ : -band_;
    return false;
  }
  const int first = ((cell.z - bz * kBrick) * kBrickNodes + (cell.y - by * kBrick)) * kBrickNodes +
                    (cell.x - bx * kBrick);
  const std::int16_t* node = bricks_[static_cast<std::size_t>(at)].node.data() + first;
  result = CellPolynomial::of_nodes<kBrickNodes>(node, unit_);
  return true;
}

}  // namespace carpus::fields
