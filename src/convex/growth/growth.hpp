// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Do two convex bodies meet? By the growth program on the facets of both, warm from query to query;
// exactly right for the vertices and the pose as given.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "convex/growth/growth_counts.hpp"
#include "convex/growth/growth_memory.hpp"
#include "convex/growth/proof_body.hpp"
#include "convex/growth/ready_proof.hpp"
#include "convex/pair_query.hpp"
#include "convex/relative_pose.hpp"

namespace carpus::convex {

/// How close two bodies are to touching, as a number: both bodies grown by `growth` about their
/// interior points just touch. 1: touching; 2: twice as large they would; 0.5: half as large they
/// would still.
struct GrowthAnswer {
  double growth = 0;       ///< between the bounds; the program's value t
  double lower_bound = 0;  ///< equal but for rounding, about 1e-13 of it
  double upper_bound = 0;
  Vec3 point;      ///< in both grown bodies, in the first's frame; in both bodies if growth <= 1
  Vec3 direction;  ///< unit, from the first to the second, of a plane between them if growth > 1
};

/// Exact: a proof in doubles where their rounding leaves no doubt, exact arithmetic elsewhere.
/// Unknown only for a pose that is not finite or larger than kLargestCoordinate.
/// Cost: see README.md.
class alignas(64) GrowthQuery final : public PairQuery {
 public:
  GrowthQuery(const ConvexBody& first, const ConvexBody& second);

  [[nodiscard]] Verdict meets(const PairPose& first_from_second) noexcept override {
    ++queries_;
    const Verdict again = ready_.again(first_from_second);
    if (again == Verdict::Unknown) return decide(first_from_second);
    ++by_last_proof_;
    return again;
  }
  void forget() noexcept override {
    memory_ = {};
    ready_ = {};
  }

  /// The program's value. Empty where a body or the pose is beyond doubles.
  [[nodiscard]] std::optional<GrowthAnswer> growth(const PairPose& first_from_second) noexcept;

  [[nodiscard]] GrowthCounts counts() const noexcept {
    GrowthCounts sum = counts_;
    sum.queries = queries_;
    sum.by_last_proof = by_last_proof_;
    return sum;
  }

 private:
  [[nodiscard]] Verdict decide(const PairPose& first_from_second) noexcept;
  /// Where there is nothing to go on from.
  [[nodiscard]] bool spheres_part(const RelativePose& pose, const Vec3& translation) noexcept;

  // In the order in which a query reads them.
  std::uint64_t queries_ = 0;
  std::uint64_t by_last_proof_ = 0;
  ReadyProof ready_;
  const ConvexBody* first_;
  const ConvexBody* second_;
  ProofBody first_proofs_;
  ProofBody second_proofs_;
  bool is_usable_ = false;
  GrowthMemory memory_;
  GrowthCounts counts_;
};

[[nodiscard]] std::unique_ptr<PairQuery> make_growth_query(const ConvexBody& first,
                                                           const ConvexBody& second);

}  // namespace carpus::convex
