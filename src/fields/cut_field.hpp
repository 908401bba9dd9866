// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What tools have taken out of one bone, as contact and density read it: a finer field beside the
// bone's own, bricks of 4 x 4 x 4 cells where something was cut, nothing elsewhere. The bone's
// field is never written, so any number of exercises share one case.
//
// Let d be the signed distance to the bone B, T the union of all swept tools (swept_tool.hpp), t
// the least of their signed distances, D the signed distance to what is left, B less T. The nodes
// of the cut field hold c = -t, clamped to at least -depth (kCutDepthMm). Of g = max(d, c):
//  - g < 0 in what is left and nowhere else; there g = D exactly: the nearest place outside is the
//    nearest one outside B or the nearest one in T, and t is exact outside T.
//  - Elsewhere 0 <= g <= D: what is left lies in B and outside every tool, so it is at least as far
//    as B and as the depth in any tool.
//  - d, c and g change by no more than the way, clamped or not. So bound (1) of contact_field.hpp
//    holds for both samples with their own spacings: |f_d - d| <= e_d, |f_c - c| <= e_c, and
//    |max(f_d, f_c) - g| <= max(e_d, e_c).
//  - Bound (2) holds from below: no node of c exceeds in magnitude the distance S to the outside of
//    T (signed, positive in T), so f_c^2 <= S^2 + V and S <= D where f_c > sqrt(V). In what is left
//    it holds for c as it does for d.
// What is lost: outside, g is a lower bound of D and no more. In front of a wall that was drilled
// away d still tells the way to that wall, and at a hole's sharp rim the true distance is up to
// sqrt(2) g. A tool in its own track is free, though: every ball that was swept has -t >= its
// radius. An upper bound of D needs a place that is proven to be bone: contact/cut_contact.hpp
// finds one. Depths end at kCutDepthMm in a bone that was cut.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fields/contact_field.hpp"
#include "geometry/vec3.hpp"

namespace carpus::fields {

/// How deep in what is left the field reaches [mm]: a ball whose centre is deeper is as good as
/// buried. Deeper would cost time: each tick of drilling writes all nodes so near to the tip.
inline constexpr double kCutDepthMm = 0.75;
/// Depths in a hole are clamped to this [mm]: the widest tool's radius.
inline constexpr double kCutReachMm = 4.0;
/// A node's step [mm]; a power of two, so that sums are exact.
inline constexpr double kCutUnitMm = 0x1p-12;
/// Cells of the cut field in one of the bone's field, by axis.
inline constexpr int kCutCellsPerCell = 2;
/// A node may be off by this: half a step, a step that is not worth a change (a tool back in its
/// own track changes nothing), and distances in float, up to 60 mm from the tool's origin.
inline constexpr double kCutRoundingMm = 1.5 * kCutUnitMm + 4e-5;

/// Nodes of 4 x 4 x 4 cells, borders with their neighbours' included, x fastest; in kCutUnitMm.
struct alignas(64) CutBrick {
  static constexpr int kCells = 4;
  static constexpr int kNodes = kCells + 1;  ///< by axis
  static constexpr std::size_t kNodeCount = std::size_t{kNodes} * kNodes * kNodes;
  static constexpr auto kUncut = static_cast<std::int16_t>(-kCutDepthMm / kCutUnitMm);
  static constexpr auto kDeepest = static_cast<std::int16_t>(kCutReachMm / kCutUnitMm);

  CutBrick() noexcept { node.fill(kUncut); }
  std::array<std::int16_t, 128> node;  ///< the last three stay kUncut

  /// Place of a node's low corner cell, each coordinate 0 to 3.
  [[nodiscard]] static constexpr std::size_t offset_of(int x, int y, int z) noexcept {
    return static_cast<std::size_t>((z * kNodes + y) * kNodes + x);
  }
};

/// One body's cuts, to be read; CutTissue owns and changes them.
class CutField {
 public:
  /// An uncut body.
  /// @param bone  gives extent and spacing only.
  /// @param bricks  where bricks will lie; must outlive this.
  CutField(const ContactField& bone, const CutBrick* bricks);

  [[nodiscard]] bool is_cut() const noexcept { return brick_count_ > 0; }
  [[nodiscard]] std::size_t brick_count() const noexcept { return brick_count_; }
  [[nodiscard]] double spacing_mm() const noexcept { return spacing_; }
  [[nodiscard]] double per_spacing() const noexcept { return per_spacing_; }
  /// Centre of node (0, 0, 0), that of the bone's field [mm, frame Bone].
  [[nodiscard]] const Vec3& origin() const noexcept { return origin_; }
  [[nodiscard]] const std::array<int, 3>& cell_count() const noexcept { return cells_; }
  [[nodiscard]] const std::array<int, 3>& bricks_by_axis() const noexcept {
    return bricks_by_axis_;
  }

  /// Bound (1): |sample - clamped c| is at most this.
  [[nodiscard]] double error_mm() const noexcept { return error_; }
  [[nodiscard]] double steepest() const noexcept { return steepest_; }
  /// Bounds of c, and of S where positive, where the field says `sample`: the better of (1), (2).
  [[nodiscard]] double lowest_distance(double sample) const noexcept;
  [[nodiscard]] double highest_distance(double sample) const noexcept {
    return -lowest_distance(-sample);
  }

  /// The polynomial of a cell of the cut field's grid. False: nothing was cut within kCutDepthMm of
  /// the brick, or where it was the bone is far; the polynomial is the constant -kCutDepthMm.
  [[nodiscard]] bool load(const VoxelIndex& cell, CellPolynomial& result) const noexcept;
  /// Value at a point of frame Bone; -kCutDepthMm outside the grid. Real-time.
  [[nodiscard]] double sample(const Vec3& point_in_bone) const noexcept;

  /// Share of the bone around a point that was taken out, 0 to 1: of a plane cut through a voxel of
  /// this width. Exactly 0 where nothing was cut within half that width. Real-time.
  [[nodiscard]] double removed_share(const Vec3& point_in_bone, double width_mm) const noexcept {
    return brick_count_ == 0 ? 0.0 : std::clamp(0.5 + sample(point_in_bone) / width_mm, 0.0, 1.0);
  }

  [[nodiscard]] std::size_t byte_count() const noexcept {
    return table_.size() * sizeof(table_[0]);
  }

 private:
  friend class CutTissue;
  static constexpr std::uint16_t kNoBrick = 0;

  double spacing_ = 0;
  double per_spacing_ = 0;
  double error_ = 0;
  double steepest_ = 0;
  Vec3 origin_;
  std::array<int, 3> cells_{};
  std::array<int, 3> bricks_by_axis_{};
  std::vector<std::uint16_t> table_;  ///< 1 + place of the brick
  std::size_t brick_count_ = 0;
  const CutBrick* bricks_ = nullptr;
};

inline bool CutField::load(const VoxelIndex& cell, CellPolynomial& result) const noexcept {
  const int bx = cell.x / CutBrick::kCells;
  const int by = cell.y / CutBrick::kCells;
  const int bz = cell.z / CutBrick::kCells;
  const int brick = (bz * bricks_by_axis_[1] + by) * bricks_by_axis_[0] + bx;
  const std::uint16_t at = table_[static_cast<std::size_t>(brick)];
  if (at == kNoBrick) {
    result = {};
    result.one = -kCutDepthMm;
    return false;
  }
  const std::int16_t* node =
      bricks_[at - 1U].node.data() + CutBrick::offset_of(cell.x - bx * CutBrick::kCells,
                                                         cell.y - by * CutBrick::kCells,
                                                         cell.z - bz * CutBrick::kCells);
  result = CellPolynomial::of_nodes<CutBrick::kNodes>(node, kCutUnitMm);
  return true;
}

}  // namespace carpus::fields
