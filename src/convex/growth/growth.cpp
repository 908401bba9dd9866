// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/growth.hpp"

#include "convex/growth/growth_decision.hpp"
#include "convex/growth/growth_program.hpp"

namespace carpus::convex {

GrowthQuery::GrowthQuery(const ConvexBody& first, const ConvexBody& second)
    : first_(&first),
      second_(&second),
      first_proofs_(first),
      second_proofs_(second),
      is_usable_(first_proofs_.facets->is_usable() && second_proofs_.facets->is_usable()) {}

Verdict GrowthQuery::decide(const PairPose& first_from_second) noexcept {
  const auto placed = [&] {
    return PlacedPair{{first_, Mat3::identity(), {}},
                      {second_, first_from_second.rotation, first_from_second.translation}};
  };
  const Verdict walked =
      walk_last_proofs(first_proofs_, second_proofs_, first_from_second, 0, ready_, counts_);
  if (walked != Verdict::Unknown) return walked;
  RelativePose relative;
  if (!is_usable_ ||
      !relative_pose(*first_proofs_.facets, *second_proofs_.facets, first_from_second, relative)) {
    return decide_exactly({}, placed, ready_, counts_);
  }
  if (!memory_.has_basis() && spheres_part(relative, first_from_second.translation)) {
    return Verdict::Apart;
  }
  return decide_pair(first_proofs_, second_proofs_, {first_from_second, relative}, placed, ready_,
                     memory_, counts_);
}

bool GrowthQuery::spheres_part(const RelativePose& pose, const Vec3& translation) noexcept {
  const double first_radius = first_proofs_.facets->outer_radius_mm();
  const double second_radius = second_proofs_.facets->outer_radius_mm();
  const Vec3& d = pose.offset;
  const double reach = first_radius + second_radius;
  if (!(squared_length(d) > reach * reach)) return false;
  SeparationProof spheres;
  spheres.n = normalized_or(d, {});
  spheres.m = -pose.into_second(spheres.n);
  spheres.size = 1 + 16 * kRoundoff;
  spheres.first_reach = first_radius * spheres.size;
  spheres.second_reach = second_radius * length(spheres.m) * spheres.size;
  if (!spheres.holds(pose, second_radius)) return false;
  memory_.separation = spheres;
  ready_.set(spheres, first_proofs_, second_proofs_, translation);
  ++counts_.by_spheres;
  return true;
}

std::optional<GrowthAnswer> GrowthQuery::growth(const PairPose& first_from_second) noexcept {
  RelativePose pose;
  if (!is_usable_ ||
      !relative_pose(*first_proofs_.facets, *second_proofs_.facets, first_from_second, pose)) {
    return std::nullopt;
  }
  const GrowthProgram program(first_proofs_, second_proofs_);
  const GrowthOptimum best = program.optimum(pose, memory_, counts_);
  GrowthAnswer answer;
  answer.lower_bound = best.lower;
  answer.upper_bound = best.upper;
  answer.growth = best.lower + (best.upper - best.lower) / 2;
  answer.point = best.point + program.first().origin();
  answer.direction = normalized_or(best.proof.n, {1, 0, 0});
  return answer;
}

std::unique_ptr<PairQuery> make_growth_query(const ConvexBody& first, const ConvexBody& second) {
  return std::make_unique<GrowthQuery>(first, second);
}

}  // namespace carpus::convex
