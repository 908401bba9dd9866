// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The dual simplex method on four rows:
// 1. Warm: the last rows at the new pose; one of them is exchanged if their weights are not all
//    >= 0. Cold: the facets where the line of origins leaves the bodies, and two implied rows.
// 2. t > 1: the rows prove that the bodies are apart.
// 3. The facets above the rows' point, by walks: if both gauges are at most 1 the point proves that
//    the bodies meet; if neither exceeds t this is the optimum.
// 4. Otherwise the facet that exceeds most enters, and the row with the least ratio leaves.
#include "collision/lp/growth_program.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace carpus::collision {
namespace {

/// Weights down to this count as >= 0; proofs cut them at 0 and bear the difference.
constexpr double kLeastWeight = -1e-12;

/// A gauge within this of t, relative: the optimum.
constexpr double kOptimumTolerance = 1e-13;

/// Bounds below this much above 1 are not tried as proofs: they would not bear their rounding.
constexpr double kProofMargin = 1e-15;

/// A vertex of a body lies on all its faces among some rows.
bool is_on_all(const ConvexBody& body,
               const PolarGraph& graph,
               const std::array<GrowthRow, 4>& rows,
               bool is_second,
               std::uint32_t vertex) noexcept {
  return std::all_of(rows.begin(), rows.end(), [&](const GrowthRow& row) {
    if (row.is_second != is_second || row.face == GrowthRow::kNoFace) return true;
    const auto& corners = body.faces()[graph.face_of_body(row.face)].corners;
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
  });
}

/// Up to three vertices of a body that all its faces among some rows share: a vertex, an edge, or
/// corners of a face.
struct Feature {
  std::array<std::uint32_t, 3> vertices{};
  std::uint32_t count = 0;
};

Feature feature_of(const ConvexBody& body,
                   const PolarGraph& graph,
                   const std::array<GrowthRow, 4>& rows,
                   bool is_second) noexcept {
  Feature shared;
  const auto own = std::find_if(rows.begin(), rows.end(), [&](const GrowthRow& row) {
    return row.is_second == is_second && row.face != GrowthRow::kNoFace;
  });
  if (own == rows.end()) return shared;
  for (const std::uint32_t c : body.faces()[graph.face_of_body(own->face)].corners) {
    if (shared.count == shared.vertices.size()) break;
    if (is_on_all(body, graph, rows, is_second, c)) shared.vertices[shared.count++] = c;
  }
  return shared;
}

}  // namespace

class GrowthProgram::Run {
 public:
  Run(const GrowthProgram& program,
      const RelativePose& pose,
      GrowthMemory& memory,
      GrowthCounts& counts) noexcept
      : a_(program.first()),
        b_(program.second()),
        pose_(pose),
        memory_(memory),
        counts_(counts),
        basis_(memory.rows) {}

  Verdict decide() noexcept {
    bool is_warm = start_warm();
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
    bool is_warm = start_warm();
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

  /// After look_along_line().
  void start_cold() noexcept {
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
    const double gauge = is_first ? dot(b_.row(in_second_.face).normal(), pose_.into_second(x - pose_.offset))
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

ExactHint GrowthProgram::hint(const ConvexBody& first,
                              const ConvexBody& second,
                              const GrowthMemory& memory) const noexcept {
  ExactHint hint;
  hint.direction = memory.separation.n;
  const Feature a = feature_of(first, this->first(), memory.rows, false);
  const Feature b = feature_of(second, this->second(), memory.rows, true);
  if (a.count == 0 || b.count == 0) return hint;
  hint.first_vertex = a.vertices[0];
  hint.second_vertex = b.vertices[0];
  const std::uint32_t pairs = a.count * b.count;
  if (pairs > hint.seeds.size()) return hint;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    for (std::uint32_t j = 0; j < b.count; ++j) {
      hint.seeds[hint.seed_count++] = {a.vertices[i], b.vertices[j]};
    }
  }
  return hint;
}

GrowthOptimum GrowthProgram::optimum(const RelativePose& pose,
                                     GrowthMemory& memory,
                                     GrowthCounts& counts) const noexcept {
  return Run(*this, pose, memory, counts).optimum();
}

}  // namespace carpus::collision
