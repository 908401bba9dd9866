// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/lowest_facet.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace carpus::survey {
namespace {

class Enumeration {
 public:
  Enumeration(const PosedPair& pair,
              const convex::ConvexBody& first,
              const convex::ConvexBody& second,
              const LowestFacet& known) noexcept
      : pair_(pair), first_(first), second_(second), best_(known), last_(known.point) {}

  [[nodiscard]] const LowestFacet& best() const noexcept { return best_; }

  void faces_of_first() noexcept {
    for (const hull::PolygonalFace& face : first_.faces()) {
      last_.first = face.corners.front();
      try_normal(-normal_of_first(face));
    }
  }

  void faces_of_second() noexcept {
    for (const hull::PolygonalFace& face : second_.faces()) {
      last_.second = face.corners.front();
      try_normal(normal_of_second(face));
    }
  }

  void pairs_of_edges() noexcept {
    for (std::uint32_t i = 0; i < pair_.first().size(); ++i) {
      const std::span<const std::uint32_t> ends = first_.vertex_neighbours(i);
      const std::span<const std::uint32_t> faces = first_.vertex_faces(i);
      for (std::size_t k = 0; k < ends.size(); ++k) {
        if (ends[k] < i) continue;
        const std::uint32_t right = faces[(k + ends.size() - 1) % ends.size()];
        follow_arc(i, -normal_of_first(first_.faces()[faces[k]]),
                   -normal_of_first(first_.faces()[right]));
      }
    }
  }

 private:
  /// The face's area vector over its length; corners in any convex order round.
  template <typename PointOf>
  [[nodiscard]] static Vec3 normal_of(const hull::PolygonalFace& face,
                                      const PointOf& point_of) noexcept {
    const Vec3 origin = point_of(face.corners[0]);
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < face.corners.size(); ++i) {
      sum += cross(point_of(face.corners[i]) - origin, point_of(face.corners[i + 1]) - origin);
    }
    return normalized_or(sum, {});
  }
  [[nodiscard]] Vec3 normal_of_first(const hull::PolygonalFace& face) const noexcept {
    return normal_of(face, [&](std::uint32_t i) { return pair_.on_first(i); });
  }
  [[nodiscard]] Vec3 normal_of_second(const hull::PolygonalFace& face) const noexcept {
    return normal_of(face,
                     [&](std::uint32_t i) { return pair_.rotation() * pair_.second().corner(i); });
  }

  void note(double height, const Vec3& normal, const DifferencePoint& point) noexcept {
    if (height < best_.height_mm) best_ = {height, normal, point};
  }

  void try_normal(const Vec3& n) noexcept {
    if (squared_length(n) < 0.5) return;  // a face too thin to have a normal
    last_ = pair_.point(last_.first, last_.second);
    if (dot(last_.at, n) >= best_.height_mm) return;  // the support is higher still
    last_ = pair_.farthest(n, last_, ClimbStart::LastCorner);
    note(dot(last_.at, n), n, last_);
  }

  /// Directions from `n` to `end`, along which corner i of the first body stays the farthest one.
  /// They are sums of both with weights that sum to 1 or more, so a point of the difference that is
  /// as high as the best along both ends is as high in between.
  void follow_arc(std::uint32_t i, Vec3 n, const Vec3& end) noexcept {
    if (squared_length(n) < 0.5 || squared_length(end) < 0.5) return;
    if (is_higher(i, n, end)) return;
    last_.second = pair_.second().climb(pair_.into_second(n), last_.second);
    if (is_higher(i, n, end)) return;
    for (std::size_t step = 0; step < pair_.second().size(); ++step) {
      // The corner j is farthest along n. Which neighbour becomes as far first, on the way to end?
      const std::uint32_t j = last_.second;
      const Vec3 from = pair_.into_second(n);
      const Vec3 to = pair_.into_second(end);
      std::uint32_t next = j;
      double soonest = 1;
      for (const std::uint32_t k : pair_.second().neighbours(j)) {
        const Vec3 edge = pair_.second().corner(k) - pair_.second().corner(j);
        const double rise = dot(edge, to);
        if (!(rise > 0)) continue;
        const double now = dot(edge, from);
        const double when = now < 0 ? -now / (rise - now) : 0;
        if (when < soonest) {
          soonest = when;
          next = k;
        }
      }
      if (next == j) return;
      n = normalized_or(n * (1 - soonest) + end * soonest, n);
      last_.second = next;
      const DifferencePoint p = pair_.point(i, j);
      const DifferencePoint q = pair_.point(i, next);
      note(std::max(dot(p.at, n), dot(q.at, n)), n, q);
    }
  }

  [[nodiscard]] bool is_higher(std::uint32_t i, const Vec3& n, const Vec3& end) noexcept {
    last_ = pair_.point(i, last_.second);
    return dot(last_.at, n) >= best_.height_mm && dot(last_.at, end) >= best_.height_mm;
  }

  const PosedPair& pair_;
  const convex::ConvexBody& first_;
  const convex::ConvexBody& second_;
  LowestFacet best_;
  DifferencePoint last_;
};

}  // namespace

LowestFacet lowest_facet(const PosedPair& pair,
                         const convex::ConvexBody& first,
                         const convex::ConvexBody& second,
                         const LowestFacet& known) noexcept {
  Enumeration enumeration(pair, first, second, known);
  enumeration.faces_of_first();
  enumeration.faces_of_second();
  enumeration.pairs_of_edges();
  return enumeration.best();
}

}  // namespace carpus::survey
