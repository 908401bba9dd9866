// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "collision/lp/growth.hpp"

#include <cmath>

namespace carpus::collision {

GrowthQuery::GrowthQuery(const ConvexBody& first, const ConvexBody& second)
    : first_(&first),
      second_(&second),
      first_proofs_(first),
      second_proofs_(second),
      program_(first_proofs_, second_proofs_),
      second_radius_mm_(program_.second().outer_radius_mm()),
      is_usable_(program_.first().is_usable() && program_.second().is_usable()) {}

Verdict GrowthQuery::decide(const PairPose& first_from_second) noexcept {
  const Verdict from_last = ready_.from_last(first_proofs_, second_proofs_, first_from_second);
  if (from_last != Verdict::Unknown) {
    ++counts_.by_walking;
    return from_last;
  }
  RelativePose pose;
  if (is_usable_ && relative_pose(program_.first(), program_.second(), first_from_second, pose)) {
    const Verdict verdict = decide_in_doubles(pose);
    const Vec3& t = first_from_second.translation;
    if (verdict == Verdict::Apart) {
      ready_.set(memory_.separation, first_proofs_, second_proofs_, t);
    } else if (verdict == Verdict::Meet) {
      ready_.set(memory_.ball, first_proofs_, second_proofs_, t);
    }
    if (verdict != Verdict::Unknown) return verdict;
  }
  return decide_exactly(first_from_second);
}

Verdict GrowthQuery::decide_in_doubles(const RelativePose& pose) noexcept {
  // Spheres first, where there is nothing to go on from.
  if (!memory_.has_basis) {
    const double reach = program_.first().outer_radius_mm() + second_radius_mm_;
    const Vec3& d = pose.offset;
    SeparationProof spheres;
    spheres.n = normalized_or(d, {});
    spheres.m = -pose.into_second(spheres.n);
    spheres.size = 1 + 16 * kRoundoff;
    spheres.first_reach = program_.first().outer_radius_mm() * spheres.size;
    spheres.second_reach = second_radius_mm_ * length(spheres.m) * spheres.size;
    if (squared_length(d) > reach * reach && spheres.holds(pose, second_radius_mm_)) {
      memory_.separation = spheres;
      ++counts_.by_spheres;
      return Verdict::Apart;
    }
  }
  return program_.decide(pose, memory_, counts_);
}

Verdict GrowthQuery::decide_exactly(const PairPose& first_from_second) noexcept {
  const ExactHint hint = is_usable_ ? program_.hint(*first_, *second_, memory_) : ExactHint{};
  const ExactAnswer answer =
      exactly_meet({first_, Mat3::identity(), {}},
                   {second_, first_from_second.rotation, first_from_second.translation}, hint);
  ++counts_.exact;
  counts_.exact_rounds += answer.rounds;
  ready_.set_unknown();
  return answer.verdict;
}

std::optional<GrowthAnswer> GrowthQuery::growth(const PairPose& first_from_second) noexcept {
  RelativePose pose;
  if (!is_usable_ || !relative_pose(program_.first(), program_.second(), first_from_second, pose)) {
    return std::nullopt;
  }
  const GrowthOptimum best = program_.optimum(pose, memory_, counts_);
  GrowthAnswer answer;
  answer.lower_bound = best.lower;
  answer.upper_bound = best.upper;
  answer.growth = best.lower + (best.upper - best.lower) / 2;
  answer.point = best.point + program_.first().origin();
  answer.direction = normalized_or(best.proof.n, {1, 0, 0});
  return answer;
}

std::unique_ptr<PairQuery> make_growth_query(const ConvexBody& first, const ConvexBody& second) {
  return std::make_unique<GrowthQuery>(first, second);
}

}  // namespace carpus::collision
