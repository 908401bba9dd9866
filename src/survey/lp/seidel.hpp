// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The thesis's program solved by randomised increments [seidel1991small]: rows in random order, one
// at a time; a row that cuts the optimum off holds the new one, which is a program of one dimension
// less over the rows before it. Linear in the number of rows on average, whatever their geometry;
// nothing is kept from query to query.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "convex/growth/growth_basis.hpp"
#include "convex/pair_query.hpp"
#include "survey/lp/exact_decision.hpp"
#include "survey/lp/three_rows.hpp"

namespace carpus::survey {

/// Exact, like GrowthQuery: what doubles cannot prove goes to exact arithmetic. The order of rows
/// comes from a fixed seed, so that a query is the same on every machine.
class SeidelQuery final : public convex::PairQuery {
 public:
  static constexpr std::uint64_t kSeed = 0x5E1DE1;

  SeidelQuery(const convex::ConvexBody& first,
              const convex::ConvexBody& second,
              std::uint64_t seed = kSeed);

  [[nodiscard]] convex::Verdict meets(const convex::PairPose& first_from_second) noexcept override;
  void forget() noexcept override {}
  [[nodiscard]] const LpCounts& counts() const noexcept { return counts_; }

 private:
  struct Row {
    Vec3 normal;
    double limit = 0;
  };
  struct PlanarRow {
    double u = 0;
    double v = 0;
    double limit = 0;
  };

  [[nodiscard]] convex::Verdict decide(const convex::RelativePose& pose) noexcept;
  void move_rows(const convex::RelativePose& pose) noexcept;
  /// Optimum on the plane of row `on` under the rows before it; false if there is none, with the
  /// rows that say so in conflict_.
  [[nodiscard]] bool solve_plane(std::size_t on) noexcept;
  /// The same on the line of planar row `on`.
  [[nodiscard]] bool solve_line(std::size_t on, double& u, double& v) noexcept;
  [[nodiscard]] bool is_proven_apart(const convex::RelativePose& pose) const noexcept;

  LpPair pair_;
  std::vector<convex::GrowthRow>
      order_;                      ///< six rows of the first body's box, then all in random order
  std::vector<Row> rows_;          ///< at the pose
  std::vector<PlanarRow> planar_;  ///< on the plane of the row in hand
  std::array<std::size_t, 4> conflict_{};
  double objective_u_ = 0;
  double objective_v_ = 0;
  double extent_mm_ = 0;  ///< nothing common lies further from the first's origin
  Vec3 point_;
  LpCounts counts_;
};

[[nodiscard]] std::unique_ptr<convex::PairQuery> make_seidel(const convex::ConvexBody& first,
                                                             const convex::ConvexBody& second);

}  // namespace carpus::survey
