// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/planar_hull.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hull/detail/planar_chan.hpp"
#include "hull/detail/planar_steps.hpp"

namespace carpus::hull {
namespace {

HullStatus check_points(std::span<const Vec2> points) {
  if (points.size() < 3) return HullStatus::TooFewPoints;
  bool in_range = true;
  for (const Vec2& p : points) {
    for (const double c : {p.x, p.y}) {
      if (!std::isfinite(c)) return HullStatus::NotFinite;
      const double size = std::abs(c);
      in_range = in_range && size <= kLargestCoordinate && (size >= kSmallestCoordinate || c == 0);
    }
  }
  if (!in_range) return HullStatus::ScaleRange;
  const auto other =
      std::find_if(points.begin(), points.end(), [&](const Vec2& p) { return !(p == points[0]); });
  if (other == points.end()) return HullStatus::Collinear;
  return std::all_of(other, points.end(),
                     [&](const Vec2& p) { return orient2d(points[0], *other, p) == 0; })
             ? HullStatus::Collinear
             : HullStatus::Ok;
}

}  // namespace

PlanarHullResult build_planar_hull(std::span<const Vec2> points, PlanarAlgorithm algorithm) {
  PlanarHullResult result;
  result.status = check_points(points);
  if (result.status != HullStatus::Ok) return result;
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  HullStatistics& statistics = result.statistics;
  switch (algorithm) {
    case PlanarAlgorithm::BruteForce:
      result.corners = planar_brute_force(points, all, statistics);
      break;
    case PlanarAlgorithm::GiftWrapping:
      result.corners = planar_gift_wrapping(points, all, statistics);
      break;
    case PlanarAlgorithm::Quickhull:
      result.corners = planar_quickhull(points, all, statistics);
      break;
    case PlanarAlgorithm::GrahamScan:
      result.corners = planar_graham_scan(points, all, statistics);
      break;
    case PlanarAlgorithm::Chan:
      result.corners = planar_chan(points, all, statistics);
      break;
    case PlanarAlgorithm::Hybrid:
      result.corners = planar_gift_wrapping(
          points, outside_double_triangle(points, all, statistics), statistics);
      break;
    case PlanarAlgorithm::Fast:
      result.corners =
          planar_graham_scan(points, outside_double_triangle(points, all, statistics), statistics);
      break;
  }
  return result;
}

}  // namespace carpus::hull
