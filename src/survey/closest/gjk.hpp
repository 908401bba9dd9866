// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The algorithm of Gilbert, Johnson and Keerthi in double precision, warm: the peer against which
// the project's own methods are measured, given the same walks and the same memory.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "survey/closest/posed_pair.hpp"
#include "survey/closest/simplex.hpp"

namespace carpus::survey {

/// Iterations after which GJK gives up with Unknown: a bound on the time of a query.
inline constexpr int kMaxGjkIterations = 96;

/// The iteration itself, and the simplex it keeps from query to query.
class GjkWalk {
 public:
  explicit GjkWalk(ClimbStart start) noexcept : start_(start) {}

  /// Ends as soon as a plane separates the bodies or a tetrahedron of the difference holds the
  /// origin. Meet also if the origin is within the rounding of the difference's boundary.
  [[nodiscard]] convex::Verdict decide(const PosedPair& pair) noexcept;
  /// Ends with the nearest point of the difference: Apart if it is proven to within `gap_mm`, or
  /// Unknown if rounding hides the next step; then gap_mm() says what is proven.
  [[nodiscard]] convex::Verdict find_nearest(const PosedPair& pair, double gap_mm) noexcept;
  void forget() noexcept {
    count_ = 0;
    has_axis_ = false;
  }

  /// After a query: the corners in use.
  [[nodiscard]] const std::array<DifferencePoint, 4>& points() const noexcept { return points_; }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  /// After Apart: the nearest point of points().
  [[nodiscard]] const SimplexNearest<Vec3>& nearest() const noexcept { return nearest_; }
  /// How much nearer than that the difference could be, at most: a plane across the nearest point,
  /// moved towards the origin by this much, has the whole difference behind it.
  [[nodiscard]] double gap_mm() const noexcept { return gap_mm_; }

  /// Goes on from other corners.
  void set_points(const std::array<DifferencePoint, 4>& points, std::size_t count) noexcept {
    points_ = points;
    count_ = count;
  }

 private:
  enum class Goal : bool { Verdict, Distance };
  [[nodiscard]] convex::Verdict iterate(const PosedPair& pair, Goal goal, double gap_mm) noexcept;
  void place_last(const PosedPair& pair) noexcept;
  void keep_used() noexcept;
  [[nodiscard]] bool has(const DifferencePoint& point) const noexcept;
  [[nodiscard]] bool last_axis_separates(const PosedPair& pair) noexcept;

  std::array<DifferencePoint, 4> points_{};
  std::size_t count_ = 0;
  SimplexNearest<Vec3> nearest_;
  DifferencePoint highest_;  ///< where the last walks ended
  double gap_mm_ = 0;
  bool has_axis_ = false;  ///< nearest_.point separated the bodies last time
  ClimbStart start_;
};

/// Points of both bodies that are nearest, from the nearest point of their difference, in the
/// first body's frame as PairQuery's users know it.
[[nodiscard]] convex::Closest closest_of(const PosedPair& pair,
                                         const std::array<DifferencePoint, 4>& points,
                                         const SimplexNearest<Vec3>& nearest) noexcept;

/// `gjk` and `gjk_table`. Sources: [gilbert1988distance]; caching and walks [cameron1997enhancing];
/// separating axis [vandenbergen1999gjk]; simplex [montanari2017signed].
/// Cost of a query: 2 to 10 iterations cold, 1 or 2 warm, each two walks and a 3 x 3 problem.
class Gjk final : public convex::PairQuery {
 public:
  Gjk(const convex::ConvexBody& first, const convex::ConvexBody& second, ClimbStart start)
      : first_(first.derived<convex::SupportGraph>()),
        second_(second.derived<convex::SupportGraph>()),
        walk_(start) {}

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override;
  [[nodiscard]] std::optional<convex::Closest> closest(
      const convex::PairPose& first_from_second) noexcept override;
  void forget() noexcept override { walk_.forget(); }

 private:
  const convex::SupportGraph& first_;
  const convex::SupportGraph& second_;
  GjkWalk walk_;
};

[[nodiscard]] std::unique_ptr<convex::PairQuery> make_gjk(const convex::ConvexBody& first,
                                                          const convex::ConvexBody& second);
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_gjk_table(const convex::ConvexBody& first,
                                                                const convex::ConvexBody& second);

}  // namespace carpus::survey
