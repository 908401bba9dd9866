// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The thesis's program [yaacoub2008] eq. (5.2) to (5.7): max x + y + z subject to the rows of both
// hulls, on its dual with equality (X is free), with three ways to find the row that enters.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "convex/growth/growth_basis.hpp"
#include "convex/growth/pair_proofs.hpp"
#include "convex/pair_query.hpp"
#include "survey/lp/exact_decision.hpp"

namespace carpus::survey {

/// How the row that enters the basis is found.
enum class Pricing : std::uint8_t {
  Scan,     ///< the most violated of all rows
  Partial,  ///< the most violated of the next block that has one, going round
  Walk,     ///< the most violated, by walks over facets from where the last ones ended
};

/// Sums over queries, for researchers.
struct LpCounts {
  std::uint64_t queries = 0;
  std::uint64_t by_last_proof = 0;  ///< the last four rows exclude each other still
  std::uint64_t warm_starts = 0;    ///< the last basis was dual feasible at the new pose
  std::uint64_t cold_starts = 0;
  std::uint64_t pivots = 0;
  std::uint64_t rows_seen = 0;  ///< rows evaluated by scans
  std::uint64_t walk_steps = 0;
  std::uint64_t pivot_limits = 0;
  std::uint64_t exact = 0;  ///< decided by exact arithmetic
};

/// Pivots of one query before it is handed to exact arithmetic; the most seen is 50.
inline constexpr int kMaxThreeRowPivots = 128;

/// Bodies are shrunk by this share of themselves for the program, so that its optimum, a corner of
/// what they share, lies inside both and proves it; overlaps and gaps below it go to exact
/// arithmetic.
inline constexpr double kLpShrink = 1e-10;

/// Exact, like GrowthQuery; slower. Unknown only for a pose that is not finite or larger than
/// kLargestCoordinate. Kept: the basis, and the last separation.
class ThreeRowQuery final : public convex::PairQuery {
 public:
  ThreeRowQuery(const convex::ConvexBody& first, const convex::ConvexBody& second, Pricing pricing);

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override;
  void forget() noexcept override;
  [[nodiscard]] const LpCounts& counts() const noexcept { return counts_; }

 private:
  class Basis;
  struct Violation {
    double amount = 0;  ///< gauge above the shrunk body's
    std::uint32_t face = 0;
    bool is_second = false;
  };
  enum class Outcome : std::uint8_t { Feasible, Infeasible, Stuck };

  [[nodiscard]] convex::Verdict decide(const convex::RelativePose& pose) noexcept;
  [[nodiscard]] Outcome solve(Basis& basis, const convex::RelativePose& pose) noexcept;
  [[nodiscard]] Violation most_violated(const Vec3& x, const convex::RelativePose& pose) noexcept;
  [[nodiscard]] Violation by_walk(const Vec3& x, const Vec3& s) noexcept;
  [[nodiscard]] Violation by_blocks(const Vec3& x, const Vec3& s, std::uint32_t block) noexcept;
  void set_corner_rows(Basis& basis) const noexcept;

  LpPair pair_;
  Pricing pricing_;
  Vec3 box_high_;  ///< of the first body, about its origin
  bool has_basis_ = false;
  bool is_separated_ = false;
  std::array<convex::GrowthRow, 3> rows_;
  convex::SeparationProof separation_;
  Vec3 point_;                    ///< of the last feasible optimum, about the first's origin
  std::uint32_t next_row_ = 0;    ///< where Partial goes on
  std::uint32_t first_face_ = 0;  ///< where Walk goes on
  std::uint32_t second_face_ = 0;
  LpCounts counts_;
};

[[nodiscard]] std::unique_ptr<convex::PairQuery> make_lp_scan(const convex::ConvexBody& first,
                                                              const convex::ConvexBody& second);
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_lp_partial(const convex::ConvexBody& first,
                                                                 const convex::ConvexBody& second);
[[nodiscard]] std::unique_ptr<convex::PairQuery> make_lp_walk(const convex::ConvexBody& first,
                                                              const convex::ConvexBody& second);

}  // namespace carpus::survey
