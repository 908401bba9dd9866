// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/planar_chan.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/check.hpp"

namespace carpus::hull {
namespace {

/// At least three vertices are left in the smallest polygon.
constexpr std::size_t kTopVertices = 3;

/// Of the same position the lowest index; of one ray the farther; else the one to the right.
bool is_better(std::span<const Vec2> points,
               const Vec2& from,
               std::uint32_t best,
               std::uint32_t other,
               HullStatistics& statistics) {
  if (points[other] == points[best]) return other < best;
  const int side = turn(from, points[best], points[other], statistics);
  return side < 0 || (side == 0 && is_beyond(from, points[best], points[other]));
}

/// Nothing if there are more corners than `most`.
std::optional<PlanarCorners> march(std::span<const Vec2> points,
                                   const std::vector<PlanarCorners>& polygons,
                                   std::uint32_t start,
                                   std::size_t most,
                                   HullStatistics& statistics) {
  PlanarCorners corners;
  std::uint32_t at = start;
  do {
    if (corners.size() == most) return std::nullopt;
    corners.push_back(at);
    std::uint32_t next = at;
    for (const PlanarCorners& polygon : polygons) {
      if (polygon.size() == 1 && points[polygon[0]] == points[at]) continue;
      const std::uint32_t s = right_tangent(points, polygon, points[at], statistics);
      if (next == at || is_better(points, points[at], next, s, statistics)) next = s;
    }
    ++statistics.facets_created;
    at = next;
  } while (at != start);
  return corners;
}

}  // namespace

std::uint32_t right_tangent(std::span<const Vec2> points,
                            std::span<const std::uint32_t> polygon,
                            const Vec2& from,
                            HullStatistics& statistics) {
  const std::size_t count = polygon.size();
  std::size_t stride = 1;
  while ((count - 1) / (2 * stride) + 1 >= kTopVertices) stride *= 2;
  std::size_t best = count;
  for (std::size_t i = 0; i < count; i += stride) {
    if (points[polygon[i]] == from) continue;
    if (best == count || is_better(points, from, polygon[best], polygon[i], statistics)) best = i;
  }
  CARPUS_CHECK(best != count);
  const auto try_vertex = [&](std::size_t i) {
    const Vec2& p = points[polygon[i]];
    if (p == from || i == best) return;
    if (is_better(points, from, polygon[best], polygon[i], statistics)) best = i;
  };
  for (stride /= 2; stride > 0; stride /= 2) {
    const std::size_t last = (count - 1) / stride * stride;
    const std::size_t before = best == 0 ? last : best - stride;
    const std::size_t after = best + stride > last ? 0 : best + stride;
    try_vertex(before);
    try_vertex(after);
  }
  return polygon[best];
}

PlanarCorners planar_chan(std::span<const Vec2> points,
                          std::span<const std::uint32_t> candidates,
                          HullStatistics& statistics) {
  std::vector<std::uint32_t> left(candidates.begin(), candidates.end());
  const std::uint32_t start = least_point(points, candidates);
  // t = 0 gives N = 2, and no hull has so few corners.
  for (std::size_t n = 4;; n *= n) {
    std::vector<PlanarCorners> polygons;
    for (std::size_t begin = 0; begin < left.size(); begin += n) {
      const std::span group = std::span(left).subspan(begin, std::min(n, left.size() - begin));
      polygons.push_back(planar_graham_scan(points, group, statistics));
    }
    left.clear();
    for (const PlanarCorners& polygon : polygons) {
      left.insert(left.end(), polygon.begin(), polygon.end());
    }
    statistics.points_discarded = candidates.size() - left.size();
    auto corners = march(points, polygons, start, n, statistics);
    if (corners) return *std::move(corners);
  }
}

}  // namespace carpus::hull
