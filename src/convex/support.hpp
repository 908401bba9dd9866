// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The corner of a convex body that lies farthest in a direction, found by walking its edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "convex/convex_body.hpp"
#include "geometry/vec3.hpp"

namespace carpus::convex {

/// Where a climb ended.
struct CertainTop {
  std::uint32_t corner = 0;
  bool is_certain = false;  ///< proven to be the one highest corner, whatever was rounded
  double reach = 0;         ///< if certain: no point of the body lies higher, about centre()
};

/// Corners and edges of one body, compact and about a point inside it: positions that lie far from
/// the frame's origin lose no digits in what is computed from them. Built once, never changed.
///
/// A corner without a higher neighbour is a highest one: the edges span the cone in which the body
/// lies. That needs the edges of merged faces; triangles of one plane would do too, slower.
/// Sources: [dobkin1985linear], [cameron1997enhancing] (the walk in GJK).
class SupportGraph {
 public:
  /// About the body's interior_point(). Queries share one: body.derived<SupportGraph>().
  explicit SupportGraph(const ConvexBody& body);

  [[nodiscard]] const Vec3& centre() const noexcept { return centre_; }
  [[nodiscard]] std::size_t size() const noexcept { return corners_.size(); }
  /// Position of a corner relative to centre(), each coordinate rounded once [mm].
  [[nodiscard]] const Vec3& corner(std::uint32_t i) const noexcept { return corners_[i].at; }
  [[nodiscard]] std::span<const std::uint32_t> neighbours(std::uint32_t i) const noexcept {
    return {neighbours_.data() + corners_[i].first, corners_[i].count};
  }
  /// Largest distance of a corner from centre() [mm].
  [[nodiscard]] double radius_mm() const noexcept { return radius_mm_; }

  /// A corner farthest along `direction` (of any length, in the body's frame): its height is the
  /// largest but for 8 roundings of the body's size. Few steps if `from` is near the answer; never
  /// more than there are corners. A direction that is zero or not a number gives `from`.
  [[nodiscard]] std::uint32_t climb(const Vec3& direction, std::uint32_t from) const noexcept;

  /// climb(), with a proof: every edge from the corner falls by more than rounding. Without one
  /// where the direction is all but normal to a face or an edge.
  [[nodiscard]] CertainTop certain_climb(const Vec3& direction, std::uint32_t from) const noexcept;

  /// A corner near climb()'s answer for any direction, from a table: 6 faces of a cube with 16 x 16
  /// cells each.
  [[nodiscard]] std::uint32_t near(const Vec3& direction) const noexcept;

  /// climb() from the higher one of `from` and near(direction).
  [[nodiscard]] std::uint32_t climb_with_table(const Vec3& direction,
                                               std::uint32_t from) const noexcept;

 private:
  struct alignas(32) Corner {
    Vec3 at;
    std::uint32_t first = 0;  // in neighbours_
    std::uint32_t count = 0;
  };

  /// The neighbour that lies highest, and by how much.
  struct Rise {
    std::uint32_t corner = 0;
    double height = 0;
  };
  [[nodiscard]] Rise steepest_from(std::uint32_t from, const Vec3& direction) const noexcept;

  std::vector<Corner> corners_;
  std::vector<std::uint32_t> neighbours_;
  std::vector<std::uint16_t> table_;  // 0 where the corner's number does not fit: a worse start
  Vec3 centre_;
  double radius_mm_ = 0;
};

}  // namespace carpus::convex
