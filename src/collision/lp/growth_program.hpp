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

#include <array>
#include <cmath>
#include <cstdint>

#include "collision/lp/exact_meeting.hpp"
#include "collision/lp/growth_basis.hpp"
#include "collision/lp/pair_proofs.hpp"
#include "collision/lp/polar_graph.hpp"
#include "collision/lp/proof_body.hpp"
#include "collision/lp/relative_pose.hpp"
#include "collision/pair_query.hpp"

namespace carpus::collision {

/// What a pair remembers: its last basis, to go on from, and the last proofs that the program
/// found.
struct GrowthMemory {
  bool has_basis = false;
  SeparationProof separation;
  CommonBallProof ball;
  std::array<GrowthRow, 4> rows;
};

/// Sums over queries, for researchers.
struct GrowthCounts {
  std::uint64_t queries = 0;
  std::uint64_t by_last_proof = 0;  ///< the last proof held at the new pose
  std::uint64_t by_walking = 0;     ///< its direction or its point did, measured anew
  std::uint64_t by_last_rows = 0;   ///< the last four rows, or the last point walked to, did
  std::uint64_t by_spheres = 0;
  std::uint64_t cold_starts = 0;
  std::uint64_t repairs = 0;  ///< a kept basis had to change one row to be of use
  std::uint64_t pivots = 0;
  std::uint64_t walk_steps = 0;  ///< facets stepped to
  std::uint64_t exact = 0;       ///< decided by exact arithmetic: touching, nearly
  std::uint64_t exact_rounds = 0;
  std::uint64_t pivot_limits = 0;  ///< of these, where the pivots ran out
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

  /// Unknown where doubles cannot tell; memory.separation then holds a direction to begin with.
  /// Does not try the last proof as it is.
  [[nodiscard]] Verdict decide(const RelativePose& pose,
                               GrowthMemory& memory,
                               GrowthCounts& counts) const noexcept;
  /// Where exact arithmetic may begin: at the rows that doubles ended on.
  [[nodiscard]] ExactHint hint(const ConvexBody& first,
                               const ConvexBody& second,
                               const GrowthMemory& memory) const noexcept;
  /// Runs to the optimum.
  [[nodiscard]] GrowthOptimum optimum(const RelativePose& pose,
                                      GrowthMemory& memory,
                                      GrowthCounts& counts) const noexcept;

 private:
  class Run;
  ProofBody first_;
  ProofBody second_;
};

}  // namespace carpus::collision
