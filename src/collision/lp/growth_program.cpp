// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The dual simplex method on four rows:
// 1. Warm: the last rows at the new pose; one of them is exchanged if their weights are not all
//    >= 0. Cold: from the facets where the line of origins leaves the bodies, or those of rows that
//    are of no use any more, to a face of one body and the vertex of the other that lies deepest
//    behind it: that face, and three about the vertex.
// 2. t > 1: the rows prove that the bodies are apart.
// 3. The facets above the rows' point, by walks: if both gauges are at most 1 the point proves that
//    the bodies meet; if neither exceeds t this is the optimum.
// 4. Otherwise the facet that exceeds most enters, and the row with the least ratio leaves.
#include "collision/lp/growth_program.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace carpus::collision {
namespace {

/// Weights down to this count as >= 0; proofs cut them at 0 and bear the difference.
constexpr double kLeastWeight = -1e-12;

/// A gauge within this of t, relative: the optimum.
constexpr double kOptimumTolerance = 1e-13;

/// Bounds below this much above 1 are not tried as proofs: they would not bear their rounding.
constexpr double kProofMargin = 1e-15;

/// Steps from a face to the one over its deepest vertex, at a cold start; two are usual.
constexpr int kMostFeatureSteps = 4;

}  // namespace

class GrowthProgram::Run {
 public:
  Run(const GrowthProgram& program,
      const RelativePose& pose,
      GrowthMemory& memory,
      GrowthCounts& counts) noexcept
      : a_(program.first()),
        b_(program.second()),
        first_corners_(*program.first_.corners),
        second_corners_(*program.second_.corners),
        pose_(pose),
        memory_(memory),
        counts_(counts),
        basis_(memory.rows) {}

  Verdict decide() noexcept {
    bool is_warm = start_warm() || start_at_faces_of_rows();
    if (!is_warm && meets_on_line()) return Verdict::Meet;
    if (!is_warm) start_cold();
    for (int pivot = 0; pivot < kMaxGrowthPivots; ++pivot) {
      if (basis_.t > 1 + kProofMargin && is_apart()) {
        if (is_warm && pivot == 0) ++counts_.by_last_rows;
        return Verdict::Apart;
      }
      climb(basis_.point());
      if (in_first_.gauge <= 1 && in_second_.gauge <= 1 && is_common(in_second_point_)) {
        if (is_warm && pivot == 0) ++counts_.by_last_rows;
        return Verdict::Meet;
      }
      if (std::max(in_first_.gauge, in_second_.gauge) <=
          basis_.t + kOptimumTolerance * (1 + std::abs(basis_.t))) {
        return give_up();
      }
      if (!exchange()) {
        if (!is_warm) return give_up();
        is_warm = false;
        if (meets_on_line()) return Verdict::Meet;
        start_cold();
      }
    }
    ++counts_.pivot_limits;
    return give_up();
  }

  GrowthOptimum optimum() noexcept {
    GrowthOptimum best;
    if (pose_.offset == Vec3{}) return {0, 0, {}, {}};  // concentric: any growth meets
    bool is_warm = start_warm() || start_at_faces_of_rows();
    if (!is_warm) {
      look_along_line();
      start_cold();
    }
    for (int pivot = 0; pivot < kMaxGrowthPivots; ++pivot) {
      if (basis_.t > best.lower) {
        best.lower = basis_.t;
        best.proof = proof_of_rows();
      }
      const Vec3 x = basis_.point();
      climb(x);
      const double upper = std::max(in_first_.gauge, in_second_.gauge);
      if (upper < best.upper) {
        best.upper = upper;
        best.point = x;
      }
      if (upper <= basis_.t + kOptimumTolerance * (1 + std::abs(basis_.t))) break;
      if (!exchange()) {
        if (!is_warm) break;
        is_warm = false;
        look_along_line();
        start_cold();
      }
    }
    return best;
  }

 private:
  [[nodiscard]] bool is_usable() const noexcept {
    return basis_.weights[basis_.worst()] >= kLeastWeight;
  }

  bool start_warm() noexcept {
    if (!memory_.has_basis) return false;
    basis_.place(pose_);
    if (!basis_.solve()) return false;
    if (is_usable()) return true;
    // The row whose weight is negative gives way to the facet farthest beyond the other three.
    ++counts_.repairs;
    const std::size_t worst = basis_.worst();
    const Vec3 d = basis_.beyond(worst);
    const PolarTop first = a_.top(d);
    const PolarTop second = b_.top(pose_.into_second(d));
    counts_.walk_steps += first.steps + second.steps;
    if (first.gauge >= second.gauge) {
      enter_first(worst, first.face);
    } else {
      enter_second(worst, second.face);
    }
    return basis_.solve() && is_usable();
  }

  /// The facets where the line of origins leaves each body towards the other.
  void look_along_line() noexcept {
    ++counts_.cold_starts;
    in_second_point_ = -pose_.into_second(pose_.offset);
    in_first_ = a_.top(pose_.offset);
    in_second_ = b_.top(in_second_point_);
    counts_.walk_steps += in_first_.steps + in_second_.steps;
  }

  /// The line of origins holds a common point.
  bool meets_on_line() noexcept {
    look_along_line();
    const double product = in_first_.gauge * in_second_.gauge;
    const double sum = in_first_.gauge + in_second_.gauge;
    if (!(sum > 0)) return is_common(Vec3{});  // concentric
    return product <= sum && is_common(in_second_point_ * (in_first_.gauge / sum));
  }

  /// A face of one body, the vertex of the other that lies deepest behind it, and the bound of t
  /// that they give.
  struct FaceAndCorner {
    double bound = -HUGE_VAL;
    std::uint32_t face = 0;
    std::uint32_t corner = 0;
  };

  /// From a face of the first body (or of the second) by steps to the face over the vertex, as long
  /// as the bound rises.
  [[nodiscard]] FaceAndCorner ascend(std::uint32_t face, bool is_of_second) const noexcept {
    const PolarGraph& faces = is_of_second ? b_ : a_;
    const SupportGraph& corners = is_of_second ? first_corners_ : second_corners_;
    FaceAndCorner best;
    for (int step = 0; step < kMostFeatureSteps; ++step) {
      // p . x - shift <= t on the one, d . x <= t (d . at) on the other, each about its origin.
      const Vec3 p = faces.row(face).normal();
      const Vec3 d = is_of_second ? -(pose_.rotation * p) : -pose_.into_second(p);
      const double along = is_of_second ? dot(d, pose_.offset) : dot(p, pose_.offset);
      const std::uint32_t corner = corners.climb(d, corners.near(d));
      const Vec3& at = corners.corner(corner);
      const double bound = along / (1 + dot(d, at));
      if (!(bound > best.bound)) break;
      best = {bound, face, corner};
      const Vec3 x =
          is_of_second ? pose_.into_second(at - pose_.offset) : pose_.rotation * at + pose_.offset;
      const std::uint32_t next = faces.climb(face, x).face;
      if (next == face) break;
      face = next;
    }
    return best;
  }

  /// From the facets on the line of origins to features that all but touch, which leave few pivots
  /// to make. False where rounding leaves no basis.
  bool start_at_features(std::uint32_t in_first, std::uint32_t in_second) noexcept {
    const FaceAndCorner best = ascend(in_first, false);
    if (!(best.bound > 1)) {
      const FaceAndCorner other = ascend(in_second, true);
      if (other.bound > best.bound) return set_rows(other, true);
    }
    return set_rows(best, false);
  }

  /// From the faces of the last rows, where these no longer make a basis.
  bool start_at_faces_of_rows() noexcept {
    if (!memory_.has_basis) return false;
    std::uint32_t in_first = GrowthRow::kNoFace;
    std::uint32_t in_second = GrowthRow::kNoFace;
    for (const GrowthRow& row : basis_.rows) (row.is_second ? in_second : in_first) = row.face;
    if (in_first == GrowthRow::kNoFace || in_second == GrowthRow::kNoFace) return false;
    return start_at_features(in_first, in_second);
  }

  /// The face's row, and those three of the faces about the vertex whose cone holds the opposite
  /// direction.
  bool set_rows(const FaceAndCorner& pair, bool is_of_second) noexcept {
    const PolarGraph& one = is_of_second ? b_ : a_;
    const PolarGraph& other = is_of_second ? a_ : b_;
    const Vec3 p = one.row(pair.face).normal();
    const Vec3 d = is_of_second ? -(pose_.rotation * p) : -pose_.into_second(p);
    const std::span<const std::uint32_t> fan = other.faces_about(pair.corner);
    const Vec3 across = cross(d, other.row(fan[0]).normal());
    std::size_t i = 2;
    while (i + 1 < fan.size() && dot(across, other.row(fan[i]).normal()) > 0) ++i;
    basis_.rows[0] = {p, pair.face, is_of_second};
    std::size_t place = 1;
    for (const std::uint32_t f : {fan[0], fan[i - 1], fan[i]}) {
      basis_.rows[place++] = {other.row(f).normal(), f, !is_of_second};
    }
    basis_.place(pose_);
    if (!basis_.solve() || !is_usable()) return false;
    return memory_.has_basis = true;
  }

  /// After look_along_line().
  void start_cold() noexcept {
    if (!start_at_features(in_first_.face, in_second_.face)) start_on_line();
  }

  void start_on_line() noexcept {
    const Vec3& line = pose_.offset;
    const double alpha = in_first_.gauge;
    const double beta = in_second_.gauge;
    const Vec3 p = a_.row(in_first_.face).normal();
    const Vec3 q = b_.row(in_second_.face).normal();
    // Weighted so that nothing is left along the line; what is left across it two implied rows
    // take up, which the larger side of the ball around a body gives.
    const Vec3 across = -(p * beta + pose_.rotation * q * alpha);
    const Vec3 side = cross(p, line);
    const Vec3 u = normalized_or(across, any_perpendicular(normalized_or(line, {1, 0, 0})));
    const Vec3 v = normalized_or(cross(u, line), normalized_or(side, {0, 0, 1}));
    const bool is_second_smaller = b_.outer_radius_mm() < a_.outer_radius_mm();
    const double reach = 0.99 / (is_second_smaller ? b_.outer_radius_mm() : a_.outer_radius_mm());
    const auto implied = [&](const Vec3& h) {
      const Vec3 in_body = is_second_smaller ? pose_.into_second(h) : h;
      return GrowthRow{normalized_or(in_body, {}) * reach, GrowthRow::kNoFace, is_second_smaller};
    };
    basis_.rows[0] = {p, in_first_.face, false};
    basis_.rows[1] = {q, in_second_.face, true};
    basis_.rows[2] = implied(u + v);
    basis_.rows[3] = implied(u - v);
    basis_.place(pose_);
    (void)basis_.solve();
    memory_.has_basis = true;
  }

  /// The facets above a point given about the first's origin.
  void climb(const Vec3& x) noexcept {
    in_second_point_ = pose_.into_second(x - pose_.offset);
    in_first_ = a_.top(x);
    in_second_ = b_.top(in_second_point_);
    counts_.walk_steps += in_first_.steps + in_second_.steps;
  }

  void enter_first(std::size_t i, std::uint32_t face) noexcept {
    ++counts_.pivots;
    const Vec3 p = a_.row(face).normal();
    basis_.set(i, {p, face, false}, p, pose_);
  }
  void enter_second(std::size_t i, std::uint32_t face) noexcept {
    ++counts_.pivots;
    const Vec3 q = b_.row(face).normal();
    basis_.set(i, {q, face, true}, pose_.rotation * q, pose_);
  }

  /// One pivot; false where the rows no longer define a point.
  bool exchange() noexcept {
    const bool is_first = in_first_.gauge >= in_second_.gauge;
    if (!enter(is_first)) return false;
    // The other body's facet enters as well where it still exceeds: a pivot without walks.
    const double other = is_first ? in_second_.gauge : in_first_.gauge;
    if (other <= basis_.t) return true;
    const Vec3 x = basis_.point();
    const double gauge =
        is_first ? dot(b_.row(in_second_.face).normal(), pose_.into_second(x - pose_.offset))
                 : dot(a_.row(in_first_.face).normal(), x);
    return gauge <= basis_.t + kOptimumTolerance * (1 + std::abs(basis_.t)) || enter(!is_first);
  }

  bool enter(bool is_first) noexcept {
    const Vec3 row = is_first ? a_.row(in_first_.face).normal() : b_.row(in_second_.face).normal();
    const Vec3 turned = is_first ? row : pose_.rotation * row;
    const std::size_t leaving = basis_.leaving(turned);
    if (leaving == 4) return false;
    ++counts_.pivots;
    basis_.set(leaving, {row, is_first ? in_first_.face : in_second_.face, !is_first}, turned,
               pose_);
    return basis_.solve();
  }

  [[nodiscard]] SeparationProof proof_of_rows() const noexcept {
    SeparationProof proof;
    for (std::size_t i = 0; i < 4; ++i) {
      const GrowthRow& row = basis_.rows[i];
      const double weight = std::max(0.0, basis_.weights[i]);
      if (row.is_second) {
        proof.add_second(row.normal, weight, b_.reach());
      } else {
        proof.add_first(row.normal, weight, a_.reach());
      }
    }
    proof.finish();
    return proof;
  }

  bool is_apart() noexcept {
    const SeparationProof proof = proof_of_rows();
    if (!proof.holds(pose_, b_.outer_radius_mm())) return false;
    memory_.separation = proof;
    return true;
  }

  /// With the faces that the walks for the point ended on.
  bool is_common(const Vec3& in_second) noexcept {
    if (!prove_common_point(a_, b_, pose_, in_second, in_first_.face, in_second_.face,
                            memory_.ball)) {
      return false;
    }
    return true;
  }

  Verdict give_up() noexcept {
    memory_.separation = proof_of_rows();
    return Verdict::Unknown;
  }

  const PolarGraph& a_;
  const PolarGraph& b_;
  const SupportGraph& first_corners_;
  const SupportGraph& second_corners_;
  const RelativePose& pose_;
  GrowthMemory& memory_;
  GrowthCounts& counts_;
  GrowthBasis basis_;
  PolarTop in_first_;
  PolarTop in_second_;
  Vec3 in_second_point_;
};

Verdict GrowthProgram::decide(const RelativePose& pose,
                              GrowthMemory& memory,
                              GrowthCounts& counts) const noexcept {
  return Run(*this, pose, memory, counts).decide();
}

GrowthOptimum GrowthProgram::optimum(const RelativePose& pose,
                                     GrowthMemory& memory,
                                     GrowthCounts& counts) const noexcept {
  return Run(*this, pose, memory, counts).optimum();
}

}  // namespace carpus::collision
