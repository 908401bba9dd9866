// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/lp/seidel.hpp"

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace carpus::survey {
namespace {

constexpr Vec3 kObjective{1, 1, 1};
/// As for the three rows: a hundredth of the shrinking, in gauges.
constexpr double kFeasible = kLpShrink / 100;
/// Rows that are parallel to this say nothing on the plane or line in hand.
constexpr double kParallel = 1e-14;

}  // namespace

SeidelQuery::SeidelQuery(const convex::ConvexBody& first,
                         const convex::ConvexBody& second,
                         std::uint64_t seed)
    : pair_(first, second), extent_mm_(2 * pair_.a->outer_radius_mm()) {
  const double slack = 1e-12 * pair_.a->outer_radius_mm();
  for (std::size_t i = 0; i < 3; ++i) {
    convex::GrowthRow high;
    convex::GrowthRow low;
    high.normal[i] = 1 / (first.box().high[i] - first.interior_point()[i] + slack);
    low.normal[i] = 1 / (first.box().low[i] - first.interior_point()[i] - slack);
    order_.insert(order_.end(), {high, low});
  }
  const auto add_all = [&](const convex::PolarGraph& graph, bool is_second) {
    for (std::uint32_t f = 0; f < graph.size(); ++f) {
      order_.push_back({graph.row(f).normal(), f, is_second});
    }
  };
  add_all(*pair_.a, false);
  add_all(*pair_.b, true);
  Rng rng(seed);
  for (std::size_t i = order_.size() - 1; i > 6; --i) {
    std::swap(order_[i], order_[6 + rng.below(i - 5)]);
  }
  rows_.resize(order_.size());
  planar_.resize(order_.size());
}

convex::Verdict SeidelQuery::meets(const convex::PairPose& first_from_second) noexcept {
  ++counts_.queries;
  convex::RelativePose pose;
  if (pair_.place(first_from_second, pose)) {
    const convex::Verdict verdict = decide(pose);
    if (verdict != convex::Verdict::Unknown) return verdict;
  }
  ++counts_.exact;
  return pair_.decide_exactly(first_from_second, {}).verdict;
}

void SeidelQuery::move_rows(const convex::RelativePose& pose) noexcept {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const convex::GrowthRow& row = order_[i];
    Row moved{row.normal, 1 - kLpShrink};
    if (row.is_second) {
      moved.normal = pose.rotation * row.normal;
      moved.limit += dot(moved.normal, pose.offset);
    }
    rows_[i] = moved;
  }
}

convex::Verdict SeidelQuery::decide(const convex::RelativePose& pose) noexcept {
  ++counts_.cold_starts;
  move_rows(pose);
  // The box's corner along the objective satisfies the box.
  point_ = {rows_[0].limit / rows_[0].normal.x, rows_[2].limit / rows_[2].normal.y,
            rows_[4].limit / rows_[4].normal.z};
  for (std::size_t i = 6; i < rows_.size(); ++i) {
    ++counts_.rows_seen;
    if (!(dot(rows_[i].normal, point_) > rows_[i].limit + kFeasible)) continue;
    ++counts_.pivots;
    if (!solve_plane(i))
      return is_proven_apart(pose) ? convex::Verdict::Apart : convex::Verdict::Unknown;
  }
  const Vec3 s = pose.into_second(point_ - pose.offset);
  convex::CommonBallProof proof;
  const bool is_common = convex::prove_common_point(
      *pair_.a, *pair_.b, pose, s, pair_.a->top(point_).face, pair_.b->top(s).face, proof);
  return is_common ? convex::Verdict::Meet : convex::Verdict::Unknown;
}

bool SeidelQuery::solve_plane(std::size_t on) noexcept {
  const Row& plane = rows_[on];
  const Vec3 unit = normalized_or(plane.normal, {1, 0, 0});
  const Vec3 e = any_perpendicular(unit);
  const Vec3 f = cross(unit, e);
  const Vec3 foot = plane.normal * (plane.limit / squared_length(plane.normal));
  objective_u_ = dot(kObjective, e);
  objective_v_ = dot(kObjective, f);
  const double far = extent_mm_ + length(foot);
  double u = objective_u_ >= 0 ? far : -far;
  double v = objective_v_ >= 0 ? far : -far;
  for (std::size_t i = 0; i < on; ++i) {
    ++counts_.rows_seen;
    const Row& row = rows_[i];
    planar_[i] = {dot(row.normal, e), dot(row.normal, f), row.limit - dot(row.normal, foot)};
    if (!(planar_[i].u * u + planar_[i].v * v > planar_[i].limit + kFeasible)) continue;
    conflict_ = {on, i, i, i};
    if (!solve_line(i, u, v)) return false;
  }
  point_ = foot + e * u + f * v;
  return true;
}

bool SeidelQuery::solve_line(std::size_t on, double& u, double& v) noexcept {
  const PlanarRow& line = planar_[on];
  const double square = line.u * line.u + line.v * line.v;
  if (!(square > kParallel * kParallel * squared_length(rows_[on].normal))) return false;
  const double foot_u = line.u * (line.limit / square);
  const double foot_v = line.v * (line.limit / square);
  const double along_u = -line.v / std::sqrt(square);
  const double along_v = line.u / std::sqrt(square);
  double high = 4 * extent_mm_ + std::abs(foot_u) + std::abs(foot_v) + std::abs(u) + std::abs(v);
  double low = -high;
  for (std::size_t i = 0; i < on; ++i) {
    const PlanarRow& row = planar_[i];
    const double slope = row.u * along_u + row.v * along_v;
    const double rest = row.limit - (row.u * foot_u + row.v * foot_v);
    if (slope * high > rest && slope > 0) {
      high = rest / slope;
      conflict_[2] = i;
    } else if (slope * low > rest && slope < 0) {
      low = rest / slope;
      conflict_[3] = i;
    } else if (slope == 0 && rest < 0) {
      return false;
    }
  }
  counts_.rows_seen += on;
  if (low > high) return false;
  const double end = objective_u_ * along_u + objective_v_ * along_v >= 0 ? high : low;
  u = foot_u + along_u * end;
  v = foot_v + along_v * end;
  return true;
}

/// The plane's row, the line's and the two that leave nothing of the line: Farkas' weights follow
/// from the four as in the growth program.
bool SeidelQuery::is_proven_apart(const convex::RelativePose& pose) const noexcept {
  std::array<convex::GrowthRow, 4> four;
  for (std::size_t i = 0; i < 4; ++i) four[i] = order_[conflict_[i]];
  convex::GrowthBasis basis(four);
  basis.place(pose);
  if (!basis.solve()) return false;
  convex::SeparationProof proof;
  for (std::size_t i = 0; i < 4; ++i) {
    const double weight = std::max(0.0, basis.weights[i]);
    if (four[i].is_second) {
      proof.add_second(four[i].normal, weight, pair_.b->reach());
    } else {
      proof.add_first(four[i].normal, weight, pair_.a->reach());
    }
  }
  proof.finish();
  return proof.holds(pose, pair_.b->outer_radius_mm());
}

std::unique_ptr<convex::PairQuery> make_seidel(const convex::ConvexBody& first,
                                               const convex::ConvexBody& second) {
  return std::make_unique<SeidelQuery>(first, second);
}

}  // namespace carpus::survey
