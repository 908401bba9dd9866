// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The growth program of one pair: how much must both bodies grow, each about its own origin, until
// they touch? [ong1996growth] As a linear program over the facets of both, like the thesis's (5.2)
// with one variable more:
//     minimise t  subject to  p . x <= t  for all rows p of both bodies, each about its origin.
// They meet iff t <= 1. Unlike (5.2) it is never infeasible, and any basis bounds t from below
// while any point bounds it from above: the query stops as soon as either is on one side of 1.
#pragma once

#include <cmath>
#include <cstdint>

#include "convex/exact_meeting.hpp"
#include "convex/growth/growth_counts.hpp"
#include "convex/growth/growth_memory.hpp"
#include "convex/growth/pair_proofs.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/pair_query.hpp"
#include "convex/polar_graph.hpp"
#include "convex/relative_pose.hpp"

namespace carpus::convex {

/// What a look at a few rows tells; memory.separation or memory.ball prove the first two.
enum class GrowthLook : std::uint8_t {
  Open,
  Apart,
  Meet,
  Touching,  ///< apart or touching; doubles cannot tell
};

/// Pivots of one query before it is handed to exact arithmetic; the most seen is about 25.
inline constexpr int kMaxGrowthPivots = 64;

/// The optimum, not only on which side of 1 it is.
struct GrowthOptimum {
  double lower = 0;  ///< the program's value lies between, but for rounding
  double upper = HUGE_VAL;
  Vec3 point;             ///< reaches `upper`; about the first's origin
  SeparationProof proof;  ///< of `lower`
};

class GrowthProgram {
 public:
  GrowthProgram(const ProofBody& first, const ProofBody& second) noexcept
      : first_(first), second_(second) {}

  [[nodiscard]] const PolarGraph& first() const noexcept { return *first_.facets; }
  [[nodiscard]] const PolarGraph& second() const noexcept { return *second_.facets; }

  /// Do the last rows still prove that the bodies are apart? No Meet from these.
  [[nodiscard]] GrowthLook look_at_rows(const RelativePose& pose,
                                        GrowthMemory& memory) const noexcept;
  /// Walks from the last features, or those of the last rows, to those that touch: what do their
  /// rows prove, or a point between them? Open without a basis: from nowhere near, pivots get there
  /// sooner.
  [[nodiscard]] GrowthLook look_at_features(const RelativePose& pose,
                                            GrowthMemory& memory,
                                            GrowthCounts& counts) const noexcept;
  /// By the dual simplex method from the last rows. Unknown where doubles cannot tell.
  [[nodiscard]] Verdict decide_by_pivots(const RelativePose& pose,
                                         GrowthMemory& memory,
                                         GrowthCounts& counts) const noexcept;
  /// What the last rows stand for. False where a row is no face's.
  [[nodiscard]] bool find_features_of_rows(const GrowthMemory& memory,
                                           FeaturePair& pair) const noexcept;
  /// Where exact arithmetic may begin.
  [[nodiscard]] ExactHint hint_at(const GrowthMemory& memory,
                                  const FeaturePair& pair) const noexcept;
  /// Runs to the optimum.
  [[nodiscard]] GrowthOptimum optimum(const RelativePose& pose,
                                      GrowthMemory& memory,
                                      GrowthCounts& counts) const noexcept;

 private:
  class Run;
  ProofBody first_;
  ProofBody second_;
};

}  // namespace carpus::convex
