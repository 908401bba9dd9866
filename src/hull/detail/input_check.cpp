// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. the extreme points of each axis, of which the farthest two; 2. the point farthest from their
// line; 3. the point farthest from the plane. "Farthest" is rounded and only a good choice; that
// the choice is not degenerate is checked exactly, and any point that is not is searched otherwise.
#include "hull/detail/input_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "geometry/aabb.hpp"
#include "geometry/predicates.hpp"
#include "hull/detail/orientation.hpp"

namespace carpus::hull {
namespace {

HullStatus name_bad_coordinate(std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), is_finite) ? HullStatus::ScaleRange
                                                              : HullStatus::NotFinite;
}

HullStatus check_coordinates(std::span<const Vec3> points) {
  if (points.size() < 4) return HullStatus::TooFewPoints;
  const auto is_in_range = [](double c) {  // false for NaN
    const double size = std::abs(c);
    return (size <= kLargestCoordinate) & ((size >= kSmallestCoordinate) | (c == 0));
  };
  bool all_in_range = true;
  for (const Vec3& p : points) {
    all_in_range &= is_in_range(p.x) & is_in_range(p.y) & is_in_range(p.z);
  }
  return all_in_range ? HullStatus::Ok : name_bad_coordinate(points);
}

/// Index of the first point with the largest `measure`.
template <typename Measure>
std::uint32_t index_of_max(std::span<const Vec3> points, Measure measure) {
  std::uint32_t best = 0;
  double best_value = measure(points[0]);
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    const double value = measure(points[i]);
    if (value > best_value) {
      best_value = value;
      best = i;
    }
  }
  return best;
}

std::pair<std::uint32_t, std::uint32_t> far_pair(std::span<const Vec3> points) {
  std::array<std::uint32_t, 6> extremes{};
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (points[i][axis] < points[extremes[2 * axis]][axis]) extremes[2 * axis] = i;
      if (points[i][axis] > points[extremes[2 * axis + 1]][axis]) extremes[2 * axis + 1] = i;
    }
  }
  std::pair<std::uint32_t, std::uint32_t> best{extremes[0], extremes[1]};
  double best_span = -1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t a = extremes[2 * axis];
    const std::uint32_t b = extremes[2 * axis + 1];
    if (const double span = points[b][axis] - points[a][axis]; span > best_span) {
      best_span = span;
      best = {a, b};
    }
  }
  return best;
}

}  // namespace

StartSimplex find_start_simplex(std::span<const Vec3> points, HullStatistics& statistics) {
  StartSimplex result;
  result.status = check_coordinates(points);
  if (result.status != HullStatus::Ok) return result;

  const auto [ia, ib] = far_pair(points);
  const Vec3 a = points[ia];
  const Vec3 b = points[ib];
  result.extent = bounds_of(points).extent() * (1 + 4 * kRoundoff);
  const double size = std::max({result.extent.x, result.extent.y, result.extent.z});
  if (size == 0) {
    result.status = HullStatus::Collinear;
    return result;
  }
  const double scale = 1 / size;  // so that products neither overflow nor underflow
  const Vec3 line = (b - a) * scale;
  std::uint32_t ic = index_of_max(
      points, [&](const Vec3& p) { return squared_length(cross(line, (p - a) * scale)); });
  if (are_collinear(a, b, points[ic])) {
    const auto found = std::find_if(points.begin(), points.end(),
                                    [&](const Vec3& p) { return !are_collinear(a, b, p); });
    if (found == points.end()) {
      result.status = HullStatus::Collinear;
      return result;
    }
    ic = static_cast<std::uint32_t>(found - points.begin());
  }

  const Vec3 c = points[ic];
  const Vec3 normal = cross(line, (c - a) * scale);
  std::uint32_t id =
      index_of_max(points, [&](const Vec3& p) { return std::abs(dot(normal, (p - a) * scale)); });
  int side = counted_orient3d(a, b, c, points[id], statistics);
  for (std::uint32_t i = 0; side == 0 && i < points.size(); ++i) {
    side = counted_orient3d(a, b, c, points[i], statistics);
    id = i;
  }
  if (side == 0) {
    result.status = HullStatus::Coplanar;
    return result;
  }
  result.corners = side < 0 ? std::array{ia, ib, ic, id} : std::array{ia, ic, ib, id};
  return result;
}

}  // namespace carpus::hull
