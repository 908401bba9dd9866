// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Distance of two convex bodies as a convex quadratic program, solved by an active set that is kept
// from query to query, with a proof of the answer.
#pragma once

#include <memory>
#include <optional>

#include "convex/convex_body.hpp"
#include "convex/pair_query.hpp"
#include "survey/closest/gjk.hpp"
#include "survey/closest/posed_pair.hpp"

namespace carpus::survey {

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
class ClosestActiveSet final : public convex::PairQuery {
 public:
  ClosestActiveSet(const convex::ConvexBody& first, const convex::ConvexBody& second)
      : first_(first),
        second_(second),
        first_graph_(first.derived<convex::SupportGraph>()),
        second_graph_(second.derived<convex::SupportGraph>()),
        walk_(ClimbStart::ColdTable) {}

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override;
  [[nodiscard]] std::optional<convex::Closest> closest(
      const convex::PairPose& first_from_second) noexcept override;
  void forget() noexcept override { walk_.forget(); }

  /// Queries that needed twice the digits; the tests count them.
  [[nodiscard]] std::uint64_t wide_queries() const noexcept { return wide_queries_; }

 private:
  const convex::ConvexBody& first_;
  const convex::ConvexBody& second_;
  const convex::SupportGraph& first_graph_;
  const convex::SupportGraph& second_graph_;
  GjkWalk walk_;
  std::uint64_t wide_queries_ = 0;
};

[[nodiscard]] std::unique_ptr<convex::PairQuery> make_closest_active_set(
    const convex::ConvexBody& first,
    const convex::ConvexBody& second);

}  // namespace carpus::survey
