// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/depth.hpp"

#include "survey/closest/certain_verdict.hpp"
#include "survey/closest/epa.hpp"

namespace carpus::survey {
namespace {

/// As for distances: see active_set.cpp.
constexpr double kProvenGap = 1e-12;

/// A polytope that has grown this large is made anew: many of its corners are of earlier poses.
constexpr std::size_t kMostWarmCorners = kMostDepthCorners / 2;

}  // namespace

convex::Verdict DepthExact::meets(const convex::PairPose& first_from_second) noexcept {
  return certain_verdict(walk_, {first_graph_, second_graph_, first_from_second}, first_, second_,
                         first_from_second);
}

std::optional<DepthExact::Facet> DepthExact::grow_to_facet(const PosedPair& pair,
                                                           double gap_mm) noexcept {
  while (true) {  // ends: each turn takes a corner, and their number is bounded
    const std::uint16_t t = polytope_.lowest();
    const ExpandingPolytope::Triangle& triangle = polytope_.triangle(t);
    const DifferencePoint p =
        pair.farthest(triangle.normal, polytope_.corner(triangle.corners[0]), ClimbStart::Table);
    const double height = dot(p.at, triangle.normal);
    if (height < best_.height_mm) best_ = {height, triangle.normal, p};
    if (height - triangle.height <= gap_mm) {
      return Facet{triangle.normal,
                   height,
                   {polytope_.corner(triangle.corners[0]), polytope_.corner(triangle.corners[1]),
                    polytope_.corner(triangle.corners[2])}};
    }
    if (polytope_.grow(p, t, pair.rounding_mm()) != ExpandingPolytope::Growth::Grown) {
      return std::nullopt;
    }
    ++counts_.growths;
  }
}

std::optional<DepthExact::Facet> DepthExact::warm_facet(const PosedPair& pair,
                                                        double gap_mm) noexcept {
  if (polytope_.is_empty()) return std::nullopt;
  const bool is_usable = polytope_.corner_count() <= kMostWarmCorners && polytope_.place(pair) &&
                         polytope_.triangle(polytope_.lowest()).height > 0;
  return is_usable ? grow_to_facet(pair, gap_mm) : std::nullopt;
}

std::optional<convex::Penetration> DepthExact::penetration(
    const convex::PairPose& first_from_second) noexcept {
  const PosedPair pair(first_graph_, second_graph_, first_from_second);
  if (!pair.is_usable()) return std::nullopt;
  const double gap_mm =
      kProvenGap * (first_graph_.radius_mm() + second_graph_.radius_mm()) + pair.rounding_mm();
  best_ = {};
  std::optional<Facet> facet = warm_facet(pair, gap_mm);
  if (facet && facet->height_mm > gap_mm) {
    ++counts_.warm;
    return penetration_of(pair, facet->normal, facet->height_mm, facet->corners, 3);
  }
  polytope_.clear();
  if (walk_.decide(pair) == convex::Verdict::Apart) return std::nullopt;
  facet.reset();
  if (start_polytope(polytope_, pair, walk_)) facet = grow_to_facet(pair, gap_mm);
  if (facet) {
    if (facet->height_mm < -gap_mm) return std::nullopt;
    ++counts_.cold;
    return penetration_of(pair, facet->normal, facet->height_mm, facet->corners, 3);
  }
  polytope_.clear();
  ++counts_.enumerated;
  const LowestFacet lowest = lowest_facet(pair, first_, second_, best_);
  if (lowest.height_mm < -gap_mm) return std::nullopt;
  return penetration_of(pair, lowest.normal, lowest.height_mm, {lowest.point}, 1);
}

std::unique_ptr<convex::PairQuery> make_depth_exact(const convex::ConvexBody& first,
                                                    const convex::ConvexBody& second) {
  return std::make_unique<DepthExact>(first, second);
}

}  // namespace carpus::survey
