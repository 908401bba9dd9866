// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hierarchy of Dobkin and Kirkpatrick [dobkin1985linear] over one convex polytope, for planes
// that turn about a line until they touch it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/convex_polytope.hpp"
#include "hull/detail/orientation.hpp"
#include "hull/hull_result.hpp"

namespace carpus::hull {

/// A line through two points that does not enter the hull of all points.
struct TurningLine {
  Vec3 a;
  Vec3 b;
  Vec3 extent;  ///< bounds the difference of any two points
};

/// A plane through a line and one more point, and on which side of it others lie.
class TurningPlane {
 public:
  TurningPlane(const TurningLine& line, const Vec3& c)
      : line_(&line), c_(c), plane_(line.a, line.b, c, line.extent) {}
  /// orient3d(line.a, line.b, c, p).
  [[nodiscard]] int side_of(const Vec3& p, HullStatistics& statistics) const {
    ++statistics.orientation_tests;
    const double height = plane_.height(p);
    if (height > plane_.bound) return 1;
    if (height < -plane_.bound) return -1;
    if (p == line_->a || p == line_->b || p == c_) return 0;
    ++statistics.exact_fallbacks;
    return orient3d_exact(line_->a, line_->b, c_, p);
  }

 private:
  const TurningLine* line_;
  Vec3 c_;
  OrientedPlane plane_;
};

/// Polytopes P_0, P_1, ..., each without some vertices of the one before that are not adjacent and
/// have few neighbours; the last has at most kTopVertices. Memory and building: O(vertices).
class HullHierarchy {
 public:
  explicit HullHierarchy(ConvexPolytope polytope);

  /// A vertex w off the line such that no vertex is above the plane (line.a, line.b, w). From the
  /// last polytope to the first, the answer stays or becomes the one vertex that is above, which
  /// is a neighbour removed at this step: O(log vertices) steps. A step costs the number of
  /// neighbours of w removed there, constant on average; a vertex joined to most of the others is
  /// the worst case.
  [[nodiscard]] std::uint32_t touch(const TurningLine& line, HullStatistics& statistics) const;

  /// Adds the input indices of all vertices in the plane, which supports the polytope at `vertex`.
  void add_face(const TurningPlane& plane,
                std::uint32_t vertex,
                std::vector<std::uint32_t>& input_indices,
                HullStatistics& statistics) const;

  [[nodiscard]] const ConvexPolytope& polytope() const noexcept { return polytope_; }

  /// Linear search instead of a hierarchy up to here; above kMostNeighbours + 1, so that what is
  /// left by a removal always spans space (only the apex of a pyramid over all others does not).
  static constexpr std::size_t kTopVertices = 12;
  /// Vertices with more are not removed. Fewer than six on average, hence most have at most eight.
  static constexpr std::size_t kMostNeighbours = 8;

 private:
  /// Lists of vertices, one after the other.
  struct Lists {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> items;
    explicit Lists(const std::vector<std::vector<std::uint32_t>>& lists);
    Lists() = default;
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t v) const {
      return std::span(items).subspan(begin[v], begin[v + 1] - begin[v]);
    }
  };

  ConvexPolytope polytope_;
  Lists rings_;               ///< neighbours in the polytope itself
  Lists removed_neighbours_;  ///< of each vertex, in the order of removal
  std::vector<std::uint32_t> top_;
};

}  // namespace carpus::hull
