// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The last rows at the new pose (rows_proof.hpp), then those of the features that a short walk
//    ends on (contact_features.hpp): of a moving wrist nearly every query.
// 2. The dual simplex method on four rows. Warm: the last rows, one of which is exchanged if their
//    weights are not all >= 0. Cold: features near the line of origins.
//    t > 1: the rows prove that the bodies are apart.
//    The facets above the rows' point, by walks: if both gauges are at most 1 the point proves that
//    the bodies meet; if neither exceeds t this is the optimum.
//    Otherwise the facet that exceeds most enters, and the row with the least ratio leaves.
#include "convex/growth/growth_program.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "convex/growth/contact_features.hpp"
#include "convex/growth/growth_features.hpp"
#include "convex/growth/growth_start.hpp"
#include "convex/growth/rows_proof.hpp"

namespace carpus::convex {
namespace {

/// Weights down to this count as >= 0; proofs cut them at 0 and bear the difference.
constexpr double kLeastWeight = -1e-12;

/// A gauge within this of t, relative: the optimum.
constexpr double kOptimumTolerance = 1e-13;

/// Bounds below this much above 1 are not tried as proofs: they would not bear their rounding.
constexpr double kProofMargin = 1e-15;

void put_first_rows_first(GrowthMemory& memory) noexcept {
  if (!memory.has_basis()) return;
  const auto second_rows = std::partition(memory.rows.begin(), memory.rows.end(),
                                          [](const GrowthRow& row) { return !row.is_second; });
  memory.first_rows = static_cast<int>(second_rows - memory.rows.begin());
}

}  // namespace

class GrowthProgram::Run {
 public:
  Run(const GrowthProgram& program,
      const RelativePose& pose,
      GrowthMemory& memory,
      GrowthCounts& counts) noexcept
      : program_(program),
        first_(program.first_),
        second_(program.second_),
        a_(program.first()),
        b_(program.second()),
        pose_(pose),
        memory_(memory),
        counts_(counts),
        basis_(memory.rows) {}

  [[nodiscard]] GrowthLook look_at_features() noexcept {
    if (!memory_.has_basis()) return GrowthLook::Open;
    if (!memory_.has_features) {
      memory_.has_features = features_of_rows(first_, second_, memory_, memory_.features);
      if (!memory_.has_features) return GrowthLook::Open;
    }
    const ContactEnd end =
        walk_to_contact(*first_.features, *second_.features, pose_, memory_.features);
    if (end.kind == ContactEnd::Kind::Overlap && is_common_near_features(end.middle)) {
      return GrowthLook::Meet;
    }
    return set_rows(first_, second_, pose_, memory_.features, memory_)
               ? program_.look_at_rows(pose_, memory_)
               : GrowthLook::Open;
  }

  Verdict decide() noexcept {
    bool is_warm = start_warm() || start_at_faces_of_rows();
    if (!is_warm) {
      look_along_line();
      if (meets_on_line()) return Verdict::Meet;
      start_cold();
    }
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
        look_along_line();
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
    if (!memory_.has_basis()) return false;
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

  /// The line of origins holds a common point. After look_along_line().
  bool meets_on_line() noexcept {
    const double product = in_first_.gauge * in_second_.gauge;
    const double sum = in_first_.gauge + in_second_.gauge;
    if (!(sum > 0)) return is_common(Vec3{});  // concentric
    return product <= sum && is_common(in_second_point_ * (in_first_.gauge / sum));
  }

  bool is_common_near_features(const Vec3& x) noexcept {
    in_second_point_ = pose_.into_second(x - pose_.offset);
    in_first_ = a_.climb(face_at(first_, memory_.features.first), x);
    in_second_ = b_.climb(face_at(second_, memory_.features.second), in_second_point_);
    counts_.walk_steps += in_first_.steps + in_second_.steps;
    return in_first_.gauge <= 1 && in_second_.gauge <= 1 && is_common(in_second_point_);
  }

  /// False where rounding leaves no basis.
  bool start_from(std::uint32_t in_first, std::uint32_t in_second) noexcept {
    const FeaturePair pair = features_from_faces(first_, second_, pose_, in_first, in_second);
    (void)set_rows(first_, second_, pose_, pair, memory_);
    basis_.place(pose_);
    return basis_.solve() && is_usable();
  }

  /// From the faces of the last rows, where these no longer make a basis.
  bool start_at_faces_of_rows() noexcept {
    if (!memory_.has_basis()) return false;
    std::uint32_t in_first = GrowthRow::kNoFace;
    std::uint32_t in_second = GrowthRow::kNoFace;
    for (const GrowthRow& row : basis_.rows) (row.is_second ? in_second : in_first) = row.face;
    if (in_first == GrowthRow::kNoFace || in_second == GrowthRow::kNoFace) return false;
    return start_from(in_first, in_second);
  }

  /// After look_along_line().
  void start_cold() noexcept {
    if (!start_from(in_first_.face, in_second_.face)) start_on_line();
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
    memory_.first_rows = 2;
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

  const GrowthProgram& program_;
  const ProofBody& first_;
  const ProofBody& second_;
  const PolarGraph& a_;
  const PolarGraph& b_;
  const RelativePose& pose_;
  GrowthMemory& memory_;
  GrowthCounts& counts_;
  GrowthBasis basis_;
  PolarTop in_first_;
  PolarTop in_second_;
  Vec3 in_second_point_;
};

GrowthLook GrowthProgram::look_at_rows(const RelativePose& pose,
                                       GrowthMemory& memory) const noexcept {
  SeparationProof proof;
  if (!separation_of_rows(memory.rows, memory.first_rows, pose, first().reach(), second().reach(),
                          proof)) {
    return GrowthLook::Open;
  }
  const double radius = second().outer_radius_mm();
  if (proof.holds(pose, radius)) {
    memory.separation = proof;
    return GrowthLook::Apart;
  }
  return proof.may_hold(pose, radius) ? GrowthLook::Touching : GrowthLook::Open;
}

GrowthLook GrowthProgram::look_at_features(const RelativePose& pose,
                                           GrowthMemory& memory,
                                           GrowthCounts& counts) const noexcept {
  const GrowthLook look = Run(*this, pose, memory, counts).look_at_features();
  if (look == GrowthLook::Apart || look == GrowthLook::Meet) ++counts.by_features;
  return look;
}

Verdict GrowthProgram::decide_by_pivots(const RelativePose& pose,
                                        GrowthMemory& memory,
                                        GrowthCounts& counts) const noexcept {
  const Verdict verdict = Run(*this, pose, memory, counts).decide();
  put_first_rows_first(memory);
  return verdict;
}

GrowthOptimum GrowthProgram::optimum(const RelativePose& pose,
                                     GrowthMemory& memory,
                                     GrowthCounts& counts) const noexcept {
  const GrowthOptimum optimum = Run(*this, pose, memory, counts).optimum();
  put_first_rows_first(memory);
  return optimum;
}

bool GrowthProgram::find_features_of_rows(const GrowthMemory& memory,
                                          FeaturePair& pair) const noexcept {
  return features_of_rows(first_, second_, memory, pair);
}

ExactHint GrowthProgram::hint_at(const GrowthMemory& memory,
                                 const FeaturePair& pair) const noexcept {
  return hint_of(first_, second_, pair, memory.separation.n);
}

}  // namespace carpus::convex
