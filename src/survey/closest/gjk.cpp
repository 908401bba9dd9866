// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The corners that mattered last are placed at the new pose.
// 2. v := the point of their simplex nearest to the origin; corners without weight go.
// 3. p := the point of the difference farthest towards the origin, along -v.
// 4. p . v > 0: a plane separates. p . v = v . v: v is nearest. Else p joins the simplex; again.
#include "survey/closest/gjk.hpp"

#include <cmath>
#include <limits>

namespace carpus::survey {

void GjkWalk::place_last(const PosedPair& pair) noexcept {
  if (count_ == 0) {
    // The corners that face each other along the line of centres.
    DifferencePoint start;
    start.first = pair.first().near(pair.offset());
    start.second = pair.second().near(-pair.into_second(pair.offset()));
    points_[0] = pair.farthest(-pair.offset(), start, ClimbStart::LastCorner);
    count_ = 1;
    return;
  }
  for (std::size_t i = 0; i < count_; ++i) {
    points_[i] = pair.point(points_[i].first, points_[i].second);
  }
}

void GjkWalk::keep_used() noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if ((nearest_.used >> i & 1U) == 0) continue;
    points_[kept] = points_[i];
    nearest_.weights[kept] = nearest_.weights[i];
    ++kept;
  }
  for (std::size_t i = kept; i < 4; ++i) nearest_.weights[i] = 0;
  count_ = kept;
  nearest_.used = static_cast<std::uint8_t>((1U << kept) - 1U);
}

bool GjkWalk::has(const DifferencePoint& point) const noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    if (points_[i].first == point.first && points_[i].second == point.second) return true;
  }
  return false;
}

bool GjkWalk::last_axis_separates(const PosedPair& pair) noexcept {
  if (!has_axis_) return false;
  const Vec3& v = nearest_.point;
  highest_ = pair.farthest(-v, highest_, ClimbStart::LastCorner);
  return dot(highest_.at, v) > pair.rounding_mm() * length(v);
}

convex::Verdict GjkWalk::iterate(const PosedPair& pair, Goal goal, double gap_mm) noexcept {
  if (!pair.is_usable()) return convex::Verdict::Unknown;
  if (goal == Goal::Verdict && last_axis_separates(pair)) return convex::Verdict::Apart;
  has_axis_ = false;
  // A warm walk mostly ends where it starts: looking the table up would be half its cost.
  ClimbStart start = start_;
  if (start == ClimbStart::ColdTable) {
    start = count_ == 0 ? ClimbStart::Table : ClimbStart::LastCorner;
  }
  place_last(pair);
  const double rounding = pair.rounding_mm();
  double last_squared = std::numeric_limits<double>::infinity();
  bool is_stuck = false;
  for (int iteration = 0; iteration < kMaxGjkIterations; ++iteration) {
    nearest_ = nearest_of_simplex<Vec3>(
        {points_[0].at, points_[1].at, points_[2].at, points_[3].at}, count_);
    if (nearest_.contains_origin) return convex::Verdict::Meet;
    keep_used();
    const Vec3& v = nearest_.point;
    const double squared = squared_length(v);
    if (!(squared > rounding * rounding)) return convex::Verdict::Meet;
    is_stuck = is_stuck || !(squared < last_squared);
    last_squared = squared;
    const DifferencePoint p = pair.farthest(-v, points_[count_ - 1], start);
    const double away = dot(p.at, v) / std::sqrt(squared);
    has_axis_ = away > rounding;
    highest_ = p;
    if (goal == Goal::Verdict && has_axis_) return convex::Verdict::Apart;
    gap_mm_ = std::sqrt(squared) - away;
    if (gap_mm_ <= gap_mm) return convex::Verdict::Apart;
    if (is_stuck || has(p)) return convex::Verdict::Unknown;
    points_[count_++] = p;
  }
  return convex::Verdict::Unknown;
}

convex::Verdict GjkWalk::decide(const PosedPair& pair) noexcept {
  return iterate(pair, Goal::Verdict, pair.rounding_mm());
}

convex::Verdict GjkWalk::find_nearest(const PosedPair& pair, double gap_mm) noexcept {
  return iterate(pair, Goal::Distance, gap_mm);
}

convex::Closest closest_of(const PosedPair& pair,
                           const std::array<DifferencePoint, 4>& points,
                           const SimplexNearest<Vec3>& nearest) noexcept {
  Vec3 a;
  Vec3 b;
  for (std::size_t i = 0; i < 4; ++i) {
    if (nearest.weights[i] > 0) {
      a += pair.on_first(points[i].first) * nearest.weights[i];
      b += pair.second().corner(points[i].second) * nearest.weights[i];
    }
  }
  convex::Closest result;
  result.distance_mm = length(nearest.point);
  result.normal = nearest.point / result.distance_mm;
  result.on_first = a + pair.first().centre();
  result.on_second = pair.rotation() * b + pair.offset() + pair.first().centre();
  return result;
}

convex::Verdict Gjk::meets(const convex::PairPose& first_from_second) noexcept {
  return walk_.decide({first_, second_, first_from_second});
}

std::optional<convex::Closest> Gjk::closest(const convex::PairPose& first_from_second) noexcept {
  const PosedPair pair(first_, second_, first_from_second);
  if (!pair.is_usable()) return std::nullopt;  // the walk still holds the last pose's corners
  const convex::Verdict verdict = walk_.find_nearest(pair, pair.rounding_mm());
  // Where rounding ends the search, the last point is the best that this method has.
  const bool is_apart = verdict == convex::Verdict::Apart ||
                        (verdict == convex::Verdict::Unknown && walk_.count() > 0 &&
                         walk_.gap_mm() < length(walk_.nearest().point));
  if (!is_apart) return std::nullopt;
  return closest_of(pair, walk_.points(), walk_.nearest());
}

std::unique_ptr<convex::PairQuery> make_gjk(const convex::ConvexBody& first,
                                            const convex::ConvexBody& second) {
  return std::make_unique<Gjk>(first, second, ClimbStart::LastCorner);
}

std::unique_ptr<convex::PairQuery> make_gjk_table(const convex::ConvexBody& first,
                                                  const convex::ConvexBody& second) {
  return std::make_unique<Gjk>(first, second, ClimbStart::Table);
}

}  // namespace carpus::survey
