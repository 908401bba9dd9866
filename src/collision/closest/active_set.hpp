// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Distance of two convex bodies as a convex quadratic program, solved by an active set that is kept
// from query to query, with a proof of the answer.
#pragma once

#include <memory>
#include <optional>

#include "collision/closest/gjk.hpp"
#include "collision/closest/posed_pair.hpp"
#include "collision/convex_body.hpp"
#include "collision/pair_query.hpp"

namespace carpus::collision {

/// min |sum_i w_i (b_i - a_i)|^2 over weights w >= 0 that sum to 1, one for each pair of corners.
/// At most four weights are active; the pair to enter is found by two walks over edges, pairs whose
/// weight would turn negative leave [wolfe1976nearest]. In exact arithmetic that is also how GJK
/// iterates; what differs is the end:
///
/// - An answer is proven: the plane across the nearest points has the bodies on its two sides but
///   for a gap of 1e-12 of their size, so the distance lies within that gap of the answer. A corner
///   without a higher neighbour is a highest one, so for the features of the last query one look at
///   the neighbours of two corners is the proof: that is all a coherent step costs.
/// - Where rounding would hide the next step (slivers of nearly parallel edges, bodies that all but
///   touch) the same active set goes on in twice the digits.
///
/// Distances up to 1 m: right to 1e-9 mm. Bodies count as meeting within 16 roundings of their
/// size.
class ClosestActiveSet final : public PairQuery {
 public:
  ClosestActiveSet(const ConvexBody& first, const ConvexBody& second)
      : first_(first),
        second_(second),
        first_graph_(first.derived<SupportGraph>()),
        second_graph_(second.derived<SupportGraph>()),
        walk_(ClimbStart::ColdTable) {}

  [[nodiscard]] Verdict meets(const PairPose& first_from_second) noexcept override;
  [[nodiscard]] std::optional<Closest> closest(const PairPose& first_from_second) noexcept override;
  void forget() noexcept override { walk_.forget(); }

  /// Queries that needed twice the digits; the tests count them.
  [[nodiscard]] std::uint64_t wide_queries() const noexcept { return wide_queries_; }

 private:
  const ConvexBody& first_;
  const ConvexBody& second_;
  const SupportGraph& first_graph_;
  const SupportGraph& second_graph_;
  GjkWalk walk_;
  std::uint64_t wide_queries_ = 0;
};

[[nodiscard]] std::unique_ptr<PairQuery> make_closest_active_set(const ConvexBody& first,
                                                                 const ConvexBody& second);

}  // namespace carpus::collision
