// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Penetration depth by the expanding polytope algorithm as it is usually built: after GJK, anew at
// each query, until the depth changes by less than a tolerance. The peer for depth_exact.
#pragma once

#include <memory>
#include <optional>

#include "survey/closest/expanding_polytope.hpp"
#include "survey/closest/gjk.hpp"

namespace carpus::survey {

/// Corners of the polytope at most; where they do not suffice the answer is what was reached.
inline constexpr std::size_t kMostEpaCorners = 128;
/// The polytope grows until its nearest triangle is this near to the difference's boundary [mm].
inline constexpr double kEpaToleranceMm = 1e-6;

/// Four points of the difference that span a tetrahedron, the first one farthest along `direction`.
[[nodiscard]] std::array<DifferencePoint, 4> spanning_points(const PosedPair& pair,
                                                             const Vec3& direction) noexcept;

/// The tetrahedron with which GJK ended, or spanning_points() where it ended without one (touching
/// bodies) or with a flat one. False if there is no tetrahedron at all.
[[nodiscard]] bool start_polytope(ExpandingPolytope& polytope,
                                  const PosedPair& pair,
                                  const GjkWalk& walk) noexcept;

/// The answer for a supporting plane of the difference that is `height_mm` above the origin, whose
/// foot is a point of the difference; `near` are points about it.
[[nodiscard]] convex::Penetration penetration_of(const PosedPair& pair,
                                                 const Vec3& normal,
                                                 double height_mm,
                                                 const std::array<DifferencePoint, 4>& near,
                                                 std::size_t near_count) noexcept;

/// Sources: [vandenbergen2001depth]. Cost: some 6 growths for two hulls of wrist bones.
class Epa final : public convex::PairQuery {
 public:
  Epa(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : first_(first.derived<convex::SupportGraph>()),
        second_(second.derived<convex::SupportGraph>()),
        walk_(ClimbStart::Table),
        polytope_(kMostEpaCorners) {}

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override;
  [[nodiscard]] std::optional<convex::Penetration> penetration(
      const convex::PairPose& first_from_second) noexcept override;
  void forget() noexcept override { walk_.forget(); }

 private:
  const convex::SupportGraph& first_;
  const convex::SupportGraph& second_;
  GjkWalk walk_;
  ExpandingPolytope polytope_;
};

[[nodiscard]] std::unique_ptr<convex::PairQuery> make_epa(const convex::ConvexBody& first,
                                                          const convex::ConvexBody& second);

}  // namespace carpus::survey
