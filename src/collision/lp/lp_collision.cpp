// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Primal (5.4): max c'X, A X <= b. Dual (5.6): min b'pi, A'pi = c, pi >= 0 (the thesis prints >= c,
// which is right only for X >= 0). The dual simplex keeps three rows with pi >= 0:
// 1. X is the point where the three rows are equalities, pi their multipliers.
// 2. The row that X violates most enters; if none does by more than the tolerance, X is a common
//    point and the dual is bounded: collision.
// 3. Write the entering normal as a combination of the three. If no weight is positive the dual is
//    unbounded along it: no common point, and the four rows prove it.
// 4. Otherwise the row with the smallest pi / weight leaves.
#include "collision/lp/lp_collision.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace carpus::collision {
namespace {

/// Multipliers of the starting rows under FollowBasis: all different, so that ties in the ratio
/// test, which can make the simplex method cycle, do not arise from symmetric bodies.
constexpr std::array<double, 3> kStartMultipliers{1.0, 1.375, 1.71875};

/// Starts from other corners of `bounds` after a basis became singular.
constexpr int kMaxRestarts = 4;

struct Violation {
  std::uint32_t row = 0;
  double amount_mm = -std::numeric_limits<double>::infinity();
};

/// The row of `rows` whose normal . x - offset is largest. Four running maxima, so that the
/// comparisons do not wait for each other.
Violation most_violated(const RowArrays& rows, const Vec3& x) noexcept {
  constexpr std::uint32_t kLanes = 4;
  std::array<Violation, kLanes> best;
  const double* nx = rows.nx.data();
  const double* ny = rows.ny.data();
  const double* nz = rows.nz.data();
  const double* offset = rows.offset.data();
  const std::uint32_t count = rows.size();
  const auto consider = [&](std::uint32_t i, Violation& lane) {
    const double amount = nx[i] * x.x + ny[i] * x.y + nz[i] * x.z - offset[i];
    const bool is_more = amount > lane.amount_mm;
    lane.row = is_more ? i : lane.row;
    lane.amount_mm = is_more ? amount : lane.amount_mm;
  };
  std::uint32_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) consider(i + lane, best[lane]);
  }
  for (; i < count; ++i) consider(i, best[0]);
  for (std::uint32_t lane = 1; lane < kLanes; ++lane) {
    if (best[lane].amount_mm > best[0].amount_mm ||
        (best[lane].amount_mm == best[0].amount_mm && best[lane].row < best[0].row)) {
      best[0] = best[lane];
    }
  }
  return best[0];
}

Violation most_violated(const LpRows& rows, const Vec3& x) noexcept {
  Violation best = most_violated(*rows.first, x);
  for (std::uint32_t i = rows.first->size(); i < rows.size(); ++i) {
    const double amount = rows.row(i).signed_distance(x);
    if (amount > best.amount_mm) best = {i, amount};
  }
  return best;
}

/// Three rows and what follows from them.
class Basis {
 public:
  Basis(const LpRows& rows, const std::array<std::uint32_t, 3>& indices) noexcept
      : indices_(indices) {
    for (std::size_t i = 0; i < 3; ++i) rows_[i] = rows.row(indices[i]);
    cofactors_ = {cross(rows_[1].normal, rows_[2].normal), cross(rows_[2].normal, rows_[0].normal),
                  cross(rows_[0].normal, rows_[1].normal)};
    determinant_ = dot(rows_[0].normal, cofactors_[0]);
  }
  [[nodiscard]] bool is_usable() const noexcept {
    return std::abs(determinant_) >= kLeastBasisDeterminant;
  }
  [[nodiscard]] const std::array<std::uint32_t, 3>& indices() const noexcept { return indices_; }
  [[nodiscard]] const Vec3& normal(std::size_t i) const noexcept { return rows_[i].normal; }
  [[nodiscard]] Vec3 vertex() const noexcept {
    return (cofactors_[0] * rows_[0].offset + cofactors_[1] * rows_[1].offset +
            cofactors_[2] * rows_[2].offset) /
           determinant_;
  }
  /// Weights w with v = sum of w_i * normal_i.
  [[nodiscard]] std::array<double, 3> weights_of(const Vec3& v) const noexcept {
    return {dot(v, cofactors_[0]) / determinant_, dot(v, cofactors_[1]) / determinant_,
            dot(v, cofactors_[2]) / determinant_};
  }

 private:
  std::array<std::uint32_t, 3> indices_;
  std::array<LpRow, 3> rows_;
  std::array<Vec3, 3> cofactors_;
  double determinant_ = 0;
};

/// Three faces of `bounds` about one of its corners; corner 0 is the highest, of Sum's optimum.
std::array<std::uint32_t, 3> corner_basis(const LpRows& rows, int corner) noexcept {
  const std::uint32_t first = rows.size() - 6;
  const auto face = [&](std::uint32_t axis) {
    return first + 2 * axis + (static_cast<std::uint32_t>(corner) >> axis & 1U);
  };
  return {face(0), face(1), face(2)};
}

/// The position that leaves, or 3 if no weight is positive.
std::size_t leaving_position(const std::array<double, 3>& multipliers,
                             const std::array<double, 3>& weights) noexcept {
  std::size_t best = 3;
  double best_ratio = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(weights[i] > kLeastLpWeight)) continue;
    const double ratio = std::max(multipliers[i], 0.0) / weights[i];
    if (ratio < best_ratio || (ratio == best_ratio && weights[i] > weights[best])) {
      best = i;
      best_ratio = ratio;
    }
  }
  return best;
}

LpAnswer infeasible(const Basis& basis,
                    std::uint32_t conflict,
                    const std::array<double, 3>& weights) noexcept {
  LpAnswer answer;
  answer.status = LpStatus::Infeasible;
  const auto& b = basis.indices();
  answer.rows = {b[0], b[1], b[2], conflict};
  for (std::size_t i = 0; i < 3; ++i) answer.weights[i] = std::max(0.0, -weights[i]);
  answer.weights[3] = 1;
  return answer;
}

class DualSimplex {
 public:
  DualSimplex(const LpRows& rows, LpObjective objective, LpMemory& memory) noexcept
      : rows_(rows), objective_(objective), memory_(memory) {}

  LpAnswer run() noexcept {
    if (memory_is_usable()) {
      const Basis kept(rows_, memory_.basis);
      if (kept.is_usable()) {
        if (memory_.last == LpStatus::Infeasible && still_infeasible(kept)) return answer_;
        if (may_start_from(kept) && solve_from(kept)) return answer_;
      }
    }
    for (int corner = 0; corner < kMaxRestarts && pivots_ < kMaxLpPivots; ++corner) {
      const Basis start(rows_, corner_basis(rows_, corner));
      objective_vector_ = {};
      for (std::size_t i = 0; i < 3; ++i) {
        objective_vector_ += start.normal(i) * start_multiplier(i);
      }
      if (solve_from(start)) return answer_;
      ++restarts_;
    }
    memory_.last = LpStatus::PivotLimit;
    answer_ = {};
    answer_.pivots = pivots_;
    answer_.restarts = restarts_;
    return answer_;
  }

 private:
  [[nodiscard]] double start_multiplier(std::size_t i) const noexcept {
    return objective_ == LpObjective::Sum ? 1.0 : kStartMultipliers[i];
  }

  [[nodiscard]] bool memory_is_usable() const noexcept {
    if (memory_.last == LpStatus::PivotLimit || memory_.conflict >= rows_.size()) return false;
    return std::all_of(memory_.basis.begin(), memory_.basis.end(),
                       [&](std::uint32_t r) { return r < rows_.size(); });
  }

  /// The four rows of the last query, in their new place, exclude each other still.
  bool still_infeasible(const Basis& kept) noexcept {
    const LpRow conflict = rows_.row(memory_.conflict);
    const std::array<double, 3> weights = kept.weights_of(conflict.normal);
    if (!(conflict.signed_distance(kept.vertex()) > kContactToleranceMm)) return false;
    for (const double w : weights) {
      if (!(w <= kLeastLpWeight)) return false;
    }
    answer_ = infeasible(kept, memory_.conflict, weights);
    answer_.from_memory = true;
    return true;
  }

  /// Sets the objective; false if the kept rows are not dual feasible for it.
  bool may_start_from(const Basis& kept) noexcept {
    if (objective_ == LpObjective::Sum) {
      objective_vector_ = {1, 1, 1};
      for (const double multiplier : kept.weights_of(objective_vector_)) {
        if (!(multiplier >= 0)) return false;
      }
      return true;
    }
    objective_vector_ = {};
    for (std::size_t i = 0; i < 3; ++i) objective_vector_ += kept.normal(i) * start_multiplier(i);
    return true;
  }

  /// False where the basis became singular or the pivots ran out.
  bool solve_from(Basis basis) noexcept {
    while (basis.is_usable()) {
      const Vec3 x = basis.vertex();
      const Violation entering = most_violated(rows_, x);
      if (!(entering.amount_mm > kContactToleranceMm)) {
        if (!(entering.amount_mm <= kContactToleranceMm)) return false;  // NaN
        answer_ = {};
        answer_.status = LpStatus::Feasible;
        answer_.point = x;
        return keep(basis, entering.row);
      }
      const std::array<double, 3> weights = basis.weights_of(rows_.row(entering.row).normal);
      const std::size_t leaving = leaving_position(basis.weights_of(objective_vector_), weights);
      if (leaving == 3) {
        answer_ = infeasible(basis, entering.row, weights);
        return keep(basis, entering.row);
      }
      if (++pivots_ >= kMaxLpPivots) return false;
      std::array<std::uint32_t, 3> indices = basis.indices();
      indices[leaving] = entering.row;
      basis = Basis(rows_, indices);
    }
    return false;
  }

  bool keep(const Basis& basis, std::uint32_t conflict) noexcept {
    answer_.pivots = pivots_;
    answer_.restarts = restarts_;
    memory_ = {basis.indices(), conflict, answer_.status};
    return true;
  }

  const LpRows& rows_;
  LpObjective objective_;
  LpMemory& memory_;
  Vec3 objective_vector_;
  LpAnswer answer_;
  int pivots_ = 0;
  int restarts_ = 0;
};

}  // namespace

RowArrays::RowArrays(std::span<const Plane> planes) {
  for (const Plane& p : planes) {
    nx.push_back(p.normal.x);
    ny.push_back(p.normal.y);
    nz.push_back(p.normal.z);
    offset.push_back(p.offset);
  }
}

LpRow LpRows::row(std::uint32_t index) const noexcept {
  const std::uint32_t n = first->size();
  if (index < n) {
    return {{first->nx[index], first->ny[index], first->nz[index]}, first->offset[index]};
  }
  index -= n;
  if (index < second.size()) return second[index];
  index -= static_cast<std::uint32_t>(second.size());
  const std::size_t axis = index / 2;
  LpRow face;
  face.normal[axis] = index % 2 == 0 ? 1.0 : -1.0;
  face.offset = index % 2 == 0 ? bounds.high[axis] : -bounds.low[axis];
  return face;
}

LpAnswer solve_collision_lp(const LpRows& rows, LpObjective objective, LpMemory& memory) noexcept {
  return DualSimplex(rows, objective, memory).run();
}

}  // namespace carpus::collision
