// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/active_set.hpp"

#include "survey/closest/certain_verdict.hpp"
#include "survey/closest/wide_nearest.hpp"

namespace carpus::survey {
namespace {

/// What has to be proven of a distance, relative to the bodies' size: well above the rounding of a
/// plane through corners some millimetres apart, well below 1e-9 mm for bodies of 100 mm.
constexpr double kProvenGap = 1e-12;

double gap_to_prove_mm(const PosedPair& pair) noexcept {
  return kProvenGap * (pair.first().radius_mm() + pair.second().radius_mm()) + pair.rounding_mm();
}

}  // namespace

convex::Verdict ClosestActiveSet::meets(const convex::PairPose& first_from_second) noexcept {
  return certain_verdict(walk_, {first_graph_, second_graph_, first_from_second}, first_, second_,
                         first_from_second);
}

std::optional<convex::Closest> ClosestActiveSet::closest(
    const convex::PairPose& first_from_second) noexcept {
  const PosedPair pair(first_graph_, second_graph_, first_from_second);
  if (!pair.is_usable()) return std::nullopt;  // the walk still holds the last pose's corners
  const double gap = gap_to_prove_mm(pair);
  const convex::Verdict verdict = walk_.find_nearest(pair, gap);
  if (verdict == convex::Verdict::Meet) return std::nullopt;
  if (verdict == convex::Verdict::Apart) {
    const convex::Closest answer = closest_of(pair, walk_.points(), walk_.nearest());
    // The weights of a sliver may be poor where its plane is not.
    const Vec3 between = answer.on_second - answer.on_first;
    if (length(between - answer.normal * answer.distance_mm) <= gap) return answer;
  }
  if (walk_.count() == 0) return std::nullopt;
  ++wide_queries_;
  const WideNearest wide = wide_nearest(pair, walk_.points(), walk_.count(), gap);
  if (wide.verdict != convex::Verdict::Apart) return std::nullopt;
  walk_.set_points(wide.points, wide.count);
  return closest_of(pair, wide.points, wide.nearest);
}

std::unique_ptr<convex::PairQuery> make_closest_active_set(const convex::ConvexBody& first,
                                                           const convex::ConvexBody& second) {
  return std::make_unique<ClosestActiveSet>(first, second);
}

}  // namespace carpus::survey
