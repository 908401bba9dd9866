// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hierarchy of Dobkin and Kirkpatrick [dobkin1985linear] over one convex polytope, for planes
// that turn about a line until they touch it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "geometry/convex_polytope.hpp"
#include "hull/detail/orientation.hpp"
#include "hull/detail/shrinking_rings.hpp"
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
  /// Two points of the plane that are not on one line with `p`, another one of it.
  [[nodiscard]] std::array<Vec3, 2> poles_for(const Vec3& p) const {
    if (!are_collinear(line_->a, line_->b, p)) return {line_->a, line_->b};
    return {p == line_->a ? line_->b : line_->a, c_};
  }

 private:
  const TurningLine* line_;
  Vec3 c_;
  OrientedPlane plane_;
};

/// What HullHierarchy::add_face remembers; one for all hulls that are asked.
struct FaceSearch {
  std::vector<std::uint32_t> found;
  std::vector<std::uint32_t> asked_in;  ///< by vertex, the last call that asked it
  std::uint32_t call = 0;
};

/// Polytopes P_0, P_1, ..., each without some vertices of the one before that are not adjacent and
/// have few neighbours; the last has at most kTopVertices. Memory and building: O(vertices).
class HullHierarchy {
 public:
  /// A vertex that lost more neighbours than `short_list` is searched through its ring.
  explicit HullHierarchy(ConvexPolytope polytope, std::size_t short_list = kShortList);

  /// A vertex w off the line such that no vertex is above the plane (line.a, line.b, w). From the
  /// last polytope to the first, the answer stays or becomes the one vertex that is above, which
  /// is a neighbour removed at this step: O(log vertices) steps. A step costs the number of
  /// neighbours of w removed there, constant on average; where w lost many, at most eight tests.
  [[nodiscard]] std::uint32_t touch(const TurningLine& line, HullStatistics& statistics) const;

  /// Adds the input indices of all vertices in the plane, which supports the polytope at `vertex`.
  void add_face(const TurningPlane& plane,
                std::uint32_t vertex,
                FaceSearch& search,
                std::vector<std::uint32_t>& input_indices,
                HullStatistics& statistics) const;

  [[nodiscard]] const ConvexPolytope& polytope() const noexcept { return polytope_; }

  /// Linear search instead of a hierarchy up to here; above kMostNeighbours + 1, so that what is
  /// left by a removal always spans space (only the apex of a pyramid over all others does not).
  static constexpr std::size_t kTopVertices = 12;
  static_assert(kTopVertices > ShrinkingRings::kMostNeighbours + 1);
  /// Of 66 000 points on a sphere no vertex loses more.
  static constexpr std::size_t kShortList = 64;

 private:
  /// Lists of vertices, one after the other.
  struct Lists {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> items;
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t v) const {
      return std::span(items).subspan(begin[v], begin[v + 1] - begin[v]);
    }
  };
  /// How the ring of one vertex grows from the polytope that it was removed from to the first.
  struct GrowingRing {
    std::vector<ShrinkingRings::Neighbour> first;
    std::vector<std::array<RingGap, 2>> gaps;  ///< beside each removed neighbour
  };
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;
  /// What there is beside a plane at a vertex with a GrowingRing.
  struct RingAnswer {
    std::uint32_t above = kNone;     ///< the vertex after whose insertion the search ended
    std::uint32_t in_plane = kNone;  ///< else the number of a neighbour in the plane
  };

  void remove_vertices(ShrinkingRings& rings,
                       std::size_t short_list,
                       std::vector<ShrinkingRings::Removal>& removals);
  void sort_by_vertex(const std::vector<ShrinkingRings::Removal>& removals);
  [[nodiscard]] RingAnswer ask_ring(std::uint32_t vertex,
                                    const GrowingRing& ring,
                                    const TurningPlane& plane,
                                    const Vec3& pole,
                                    HullStatistics& statistics) const;
  template <typename Visit>
  void visit_neighbours(std::uint32_t vertex,
                        const TurningPlane& plane,
                        HullStatistics& statistics,
                        const Visit& is_in_plane) const;

  ConvexPolytope polytope_;
  Lists rings_;               ///< neighbours in the polytope itself
  Lists removed_neighbours_;  ///< of each vertex, in the order of removal
  std::unordered_map<std::uint32_t, GrowingRing> growing_rings_;  ///< only asked, never listed
  std::vector<std::uint32_t> top_;
};

}  // namespace carpus::hull
