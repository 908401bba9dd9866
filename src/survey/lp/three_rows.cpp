// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Dual simplex on three rows n_i . x <= d_i with multipliers >= 0, sum of multiplier * n = c:
// 1. x is where the three are equalities. The row that it violates enters; if there is none, x is a
//    common point of the bodies.
// 2. Write the entering normal as a combination of the three. If no weight is positive, the four
//    rows exclude each other: the bodies are apart.
// 3. Otherwise the row with the smallest multiplier / weight leaves.
#include "survey/lp/three_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carpus::survey {
namespace {

/// The thesis's objective (5.5).
constexpr Vec3 kObjective{1, 1, 1};

/// A gauge this much above the shrunk body's is no violation: a hundredth of the shrinking.
constexpr double kFeasible = kLpShrink / 100;
/// Weights up to this count as not positive; proofs are checked anyway.
constexpr double kLeastShare = 1e-12;
constexpr std::uint32_t kBlock = 64;

}  // namespace

/// Three rows at a pose and what follows from them.
class ThreeRowQuery::Basis {
 public:
  Basis(std::array<convex::GrowthRow, 3>& caller_rows, const convex::RelativePose& pose) noexcept
      : rows(caller_rows), pose_(pose) {}

  bool solve() noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      n_[i] = normal_of(rows[i]);
      d_[i] = limit_of(rows[i], n_[i]);
    }
    cofactors_ = {cross(n_[1], n_[2]), cross(n_[2], n_[0]), cross(n_[0], n_[1])};
    inverse_ = 1 / dot(n_[0], cofactors_[0]);
    return std::abs(inverse_) <= 1e300;
  }
  [[nodiscard]] Vec3 normal_of(const convex::GrowthRow& row) const noexcept {
    return row.is_second ? pose_.rotation * row.normal : row.normal;
  }
  [[nodiscard]] double limit_of(const convex::GrowthRow& row, const Vec3& normal) const noexcept {
    return 1 - kLpShrink + (row.is_second ? dot(normal, pose_.offset) : 0);
  }
  [[nodiscard]] Vec3 point() const noexcept {
    return (cofactors_[0] * d_[0] + cofactors_[1] * d_[1] + cofactors_[2] * d_[2]) * inverse_;
  }
  [[nodiscard]] std::array<double, 3> weights_of(const Vec3& v) const noexcept {
    return {dot(v, cofactors_[0]) * inverse_, dot(v, cofactors_[1]) * inverse_,
            dot(v, cofactors_[2]) * inverse_};
  }
  /// The position that leaves for a normal, or 3 if its weights are all <= 0.
  [[nodiscard]] std::size_t leaving(const std::array<double, 3>& weights) const noexcept {
    const std::array<double, 3> multipliers = weights_of(kObjective);
    std::size_t best = 3;
    double best_ratio = HUGE_VAL;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(weights[i] > kLeastShare)) continue;
      const double ratio = std::max(0.0, multipliers[i]) / weights[i];
      if (ratio < best_ratio) {
        best_ratio = ratio;
        best = i;
      }
    }
    return best;
  }
  [[nodiscard]] bool is_dual_feasible() const noexcept {
    const std::array<double, 3> multipliers = weights_of(kObjective);
    return multipliers[0] >= 0 && multipliers[1] >= 0 && multipliers[2] >= 0;
  }

  std::array<convex::GrowthRow, 3>& rows;

 private:
  const convex::RelativePose& pose_;
  std::array<Vec3, 3> n_;
  std::array<double, 3> d_{};
  std::array<Vec3, 3> cofactors_;
  double inverse_ = 0;
};

ThreeRowQuery::ThreeRowQuery(const convex::ConvexBody& first,
                             const convex::ConvexBody& second,
                             Pricing pricing)
    : pair_(first, second), pricing_(pricing) {
  // The box's faces lie outside the body by more than the rounding of both.
  const Vec3 high = first.box().high - first.interior_point();
  box_high_ = high + Vec3{1, 1, 1} * (1e-12 * pair_.a->outer_radius_mm());
}

void ThreeRowQuery::forget() noexcept {
  has_basis_ = false;
  is_separated_ = false;
  next_row_ = 0;
  first_face_ = 0;
  second_face_ = 0;
}

convex::Verdict ThreeRowQuery::meets(const convex::PairPose& first_from_second) noexcept {
  ++counts_.queries;
  convex::RelativePose pose;
  if (pair_.place(first_from_second, pose)) {
    if (is_separated_ && separation_.holds(pose, pair_.b->outer_radius_mm())) {
      ++counts_.by_last_proof;
      return convex::Verdict::Apart;
    }
    const convex::Verdict verdict = decide(pose);
    is_separated_ = verdict == convex::Verdict::Apart;
    if (verdict != convex::Verdict::Unknown) return verdict;
  }
  ++counts_.exact;
  convex::ExactHint hint;
  hint.direction = separation_.n;
  return pair_.decide_exactly(first_from_second, hint).verdict;
}

/// A corner of the first body's box, where c = (1, 1, 1) points.
void ThreeRowQuery::set_corner_rows(Basis& basis) const noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    convex::GrowthRow row;
    row.normal[i] = 1 / box_high_[i];
    basis.rows[i] = row;
  }
}

convex::Verdict ThreeRowQuery::decide(const convex::RelativePose& pose) noexcept {
  Basis basis(rows_, pose);
  Outcome outcome = Outcome::Stuck;
  if (has_basis_ && basis.solve() && basis.is_dual_feasible()) {
    ++counts_.warm_starts;
    outcome = solve(basis, pose);
  }
  if (outcome == Outcome::Stuck) {
    ++counts_.cold_starts;
    set_corner_rows(basis);
    if (basis.solve()) outcome = solve(basis, pose);
  }
  has_basis_ = outcome != Outcome::Stuck;
  if (outcome == Outcome::Infeasible && separation_.holds(pose, pair_.b->outer_radius_mm())) {
    return convex::Verdict::Apart;
  }
  if (outcome == Outcome::Feasible) {
    const Vec3 s = pose.into_second(point_ - pose.offset);
    convex::CommonBallProof proof;
    if (convex::prove_common_point(*pair_.a, *pair_.b, pose, s, pair_.a->top(point_).face,
                                   pair_.b->top(s).face, proof)) {
      return convex::Verdict::Meet;
    }
  }
  return convex::Verdict::Unknown;
}

ThreeRowQuery::Outcome ThreeRowQuery::solve(Basis& basis,
                                            const convex::RelativePose& pose) noexcept {
  for (int pivot = 0; pivot < kMaxThreeRowPivots; ++pivot) {
    const Vec3 x = basis.point();
    const Violation entering = most_violated(x, pose);
    if (!(entering.amount > kFeasible)) {
      point_ = x;
      return Outcome::Feasible;
    }
    convex::GrowthRow row;
    row.face = entering.face;
    row.is_second = entering.is_second;
    row.normal = (row.is_second ? pair_.b : pair_.a)->row(row.face).normal();
    const std::array<double, 3> weights = basis.weights_of(basis.normal_of(row));
    const std::size_t leaving = basis.leaving(weights);
    if (leaving == 3) {
      separation_ = {};
      const auto add = [&](const convex::GrowthRow& r, double weight) {
        if (r.is_second) {
          separation_.add_second(r.normal, weight, pair_.b->reach());
        } else {
          separation_.add_first(r.normal, weight, pair_.a->reach());
        }
      };
      for (std::size_t i = 0; i < 3; ++i) add(basis.rows[i], std::max(0.0, -weights[i]));
      add(row, 1);
      separation_.finish();
      return Outcome::Infeasible;
    }
    ++counts_.pivots;
    basis.rows[leaving] = row;
    if (!basis.solve()) return Outcome::Stuck;
  }
  ++counts_.pivot_limits;
  return Outcome::Stuck;
}

ThreeRowQuery::Violation ThreeRowQuery::most_violated(const Vec3& x,
                                                      const convex::RelativePose& pose) noexcept {
  const Vec3 s = pose.into_second(x - pose.offset);
  if (pricing_ == Pricing::Walk) return by_walk(x, s);
  return by_blocks(x, s, pricing_ == Pricing::Partial ? kBlock : pair_.a->size() + pair_.b->size());
}

ThreeRowQuery::Violation ThreeRowQuery::by_walk(const Vec3& x, const Vec3& s) noexcept {
  const convex::PolarTop a = pair_.a->climb(first_face_, x);
  const convex::PolarTop b = pair_.b->climb(second_face_, s);
  first_face_ = a.face;
  second_face_ = b.face;
  counts_.walk_steps += a.steps + b.steps;
  const bool is_second = b.gauge > a.gauge;
  return {(is_second ? b.gauge : a.gauge) - (1 - kLpShrink), is_second ? b.face : a.face,
          is_second};
}

/// Goes round all rows, the first body's before the second's, and stops after a block of rows with
/// a violation among them; a block of all rows makes it a full scan.
ThreeRowQuery::Violation ThreeRowQuery::by_blocks(const Vec3& x,
                                                  const Vec3& s,
                                                  std::uint32_t block) noexcept {
  const std::uint32_t first_count = pair_.a->size();
  const std::uint32_t count = first_count + pair_.b->size();
  Violation worst{-HUGE_VAL, 0, false};
  std::uint32_t at = block < count ? next_row_ : 0;
  std::uint32_t seen = 0;
  const auto is_violated = [&] { return worst.amount > 1 - kLpShrink + kFeasible; };
  while (seen < count && !(block < count && is_violated())) {
    // Rows of one body at a time.
    const bool is_second = at >= first_count;
    const convex::PolarGraph& graph = is_second ? *pair_.b : *pair_.a;
    const Vec3& d = is_second ? s : x;
    const std::uint32_t start = is_second ? at - first_count : at;
    const std::uint32_t rows = std::min({block, count - seen, graph.size() - start});
    for (std::uint32_t face = start; face < start + rows; ++face) {
      const double gauge = graph.row(face).gauge(d);
      if (gauge > worst.amount) worst = {gauge, face, is_second};
    }
    seen += rows;
    at = at + rows == count ? 0 : at + rows;
  }
  counts_.rows_seen += seen;
  next_row_ = at;
  worst.amount -= 1 - kLpShrink;
  return worst;
}

std::unique_ptr<convex::PairQuery> make_lp_scan(const convex::ConvexBody& first,
                                                const convex::ConvexBody& second) {
  return std::make_unique<ThreeRowQuery>(first, second, Pricing::Scan);
}
std::unique_ptr<convex::PairQuery> make_lp_partial(const convex::ConvexBody& first,
                                                   const convex::ConvexBody& second) {
  return std::make_unique<ThreeRowQuery>(first, second, Pricing::Partial);
}
std::unique_ptr<convex::PairQuery> make_lp_walk(const convex::ConvexBody& first,
                                                const convex::ConvexBody& second) {
  return std::make_unique<ThreeRowQuery>(first, second, Pricing::Walk);
}

}  // namespace carpus::survey
