// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/planar_steps.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

#include "core/check.hpp"

namespace carpus::hull {
namespace {

std::uint32_t least(std::span<const Vec2> points, std::span<const std::uint32_t> candidates) {
  return *std::min_element(
      candidates.begin(), candidates.end(),
      [&](std::uint32_t i, std::uint32_t j) { return is_before(points[i], points[j]); });
}
std::uint32_t greatest(std::span<const Vec2> points, std::span<const std::uint32_t> candidates) {
  return *std::max_element(
      candidates.begin(), candidates.end(),
      [&](std::uint32_t i, std::uint32_t j) { return is_before(points[i], points[j]); });
}

std::vector<std::uint32_t> sorted_distinct(std::span<const Vec2> points,
                                           std::span<const std::uint32_t> candidates) {
  std::vector<std::uint32_t> order(candidates.begin(), candidates.end());
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::tie(points[i].x, points[i].y, i) < std::tie(points[j].x, points[j].y, j);
  });
  order.erase(std::unique(order.begin(), order.end(),
                          [&](std::uint32_t i, std::uint32_t j) { return points[i] == points[j]; }),
              order.end());
  return order;
}

/// Appends the corners strictly left of a-b, in order from a to b, both excluded.
/// Each level takes one corner away, so the depth is at most h.
void quickhull_side(std::span<const Vec2> points,
                    std::span<const std::uint32_t> left,
                    std::uint32_t a,
                    std::uint32_t b,
                    PlanarCorners& corners,
                    HullStatistics& statistics) {
  if (left.empty()) return;
  std::uint32_t far = left[0];
  for (const std::uint32_t s : left.subspan(1)) {
    const int higher = compare_heights(points[a], points[b], points[far], points[s], statistics);
    // Of several at the same height the first in (x, y) is an end of their line: a corner.
    if (higher > 0 || (higher == 0 && is_before(points[s], points[far]))) far = s;
  }
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> second;
  for (const std::uint32_t s : left) {
    if (turn(points[a], points[far], points[s], statistics) > 0) {
      first.push_back(s);
    } else if (turn(points[far], points[b], points[s], statistics) > 0) {
      second.push_back(s);
    }
  }
  quickhull_side(points, first, a, far, corners, statistics);
  statistics.facets_created += 2;  // in place of a-b
  corners.push_back(far);
  quickhull_side(points, second, far, b, corners, statistics);
}

}  // namespace

std::uint32_t least_point(std::span<const Vec2> points, std::span<const std::uint32_t> candidates) {
  return least(points, candidates);
}

PlanarCorners planar_brute_force(std::span<const Vec2> points,
                                 std::span<const std::uint32_t> candidates,
                                 HullStatistics& statistics) {
  const std::vector<std::uint32_t> p = sorted_distinct(points, candidates);
  std::map<std::uint32_t, std::uint32_t> next;  // edges of the hull, from corner to corner
  for (const std::uint32_t i : p) {
    for (const std::uint32_t j : p) {
      if (i == j) continue;
      const bool is_edge = std::all_of(p.begin(), p.end(), [&](std::uint32_t k) {
        if (k == i || k == j) return true;
        const int side = turn(points[i], points[j], points[k], statistics);
        const bool is_between = !is_beyond(points[i], points[j], points[k]) &&
                                !is_beyond(points[j], points[i], points[k]);
        return side > 0 || (side == 0 && is_between);
      });
      if (!is_edge) continue;
      next[i] = j;
      ++statistics.facets_created;
    }
  }
  PlanarCorners corners{p.front()};
  while (next.at(corners.back()) != p.front()) {
    CARPUS_CHECK(corners.size() <= p.size());
    corners.push_back(next.at(corners.back()));
  }
  return corners;
}

PlanarCorners planar_gift_wrapping(std::span<const Vec2> points,
                                   std::span<const std::uint32_t> candidates,
                                   HullStatistics& statistics) {
  PlanarCorners corners;
  const std::uint32_t start = least(points, candidates);
  std::uint32_t at = start;
  do {
    CARPUS_CHECK(corners.size() <= candidates.size());
    corners.push_back(at);
    std::uint32_t next = at;
    for (const std::uint32_t s : candidates) {
      if (points[s] == points[at]) continue;
      if (next == at) {
        next = s;
        continue;
      }
      const int side = turn(points[at], points[next], points[s], statistics);
      if (side < 0 || (side == 0 && is_beyond(points[at], points[next], points[s]))) next = s;
    }
    ++statistics.facets_created;
    at = next;
  } while (at != start);
  return corners;
}

PlanarCorners planar_quickhull(std::span<const Vec2> points,
                               std::span<const std::uint32_t> candidates,
                               HullStatistics& statistics) {
  const std::uint32_t a = least(points, candidates);
  const std::uint32_t b = greatest(points, candidates);
  std::vector<std::uint32_t> above;
  std::vector<std::uint32_t> below;
  for (const std::uint32_t s : candidates) {
    const int side = turn(points[a], points[b], points[s], statistics);
    if (side > 0) above.push_back(s);
    if (side < 0) below.push_back(s);
  }
  statistics.facets_created += 2;
  PlanarCorners corners{a};
  // Counter-clockwise from the least: the lower side first, which is left of b-a.
  PlanarCorners lower;
  quickhull_side(points, below, b, a, lower, statistics);
  PlanarCorners upper;
  quickhull_side(points, above, a, b, upper, statistics);
  corners.insert(corners.end(), lower.rbegin(), lower.rend());
  corners.push_back(b);
  corners.insert(corners.end(), upper.rbegin(), upper.rend());
  return corners;
}

PlanarCorners planar_graham_scan(std::span<const Vec2> points,
                                 std::span<const std::uint32_t> candidates,
                                 HullStatistics& statistics) {
  std::vector<std::uint32_t> order = sorted_distinct(points, candidates);
  if (order.size() == 1) return order;
  PlanarCorners corners;
  const auto scan = [&](auto begin, auto end) {
    const std::size_t floor = corners.size() + 1;
    for (auto it = begin; it != end; ++it) {
      while (corners.size() > floor && turn(points[corners[corners.size() - 2]],
                                            points[corners.back()], points[*it], statistics) <= 0) {
        corners.pop_back();
      }
      if (it != begin) ++statistics.facets_created;
      corners.push_back(*it);
    }
    corners.pop_back();  // the other scan begins with it
  };
  scan(order.begin(), order.end());
  scan(order.rbegin(), order.rend());
  return corners;
}

std::vector<std::uint32_t> outside_double_triangle(std::span<const Vec2> points,
                                                   std::span<const std::uint32_t> candidates,
                                                   HullStatistics& statistics) {
  const Vec2 a = points[least(points, candidates)];
  const Vec2 b = points[greatest(points, candidates)];
  Vec2 top = a;
  Vec2 bottom = a;
  for (const std::uint32_t s : candidates) {
    if (compare_heights(a, b, top, points[s], statistics) > 0) top = points[s];
    if (compare_heights(a, b, bottom, points[s], statistics) < 0) bottom = points[s];
  }
  // A missing apex leaves a triangle without an inside.
  const std::array<std::array<Vec2, 3>, 2> triangles{{{a, b, top}, {b, a, bottom}}};
  std::vector<std::uint32_t> left;
  for (const std::uint32_t s : candidates) {
    const bool is_inner = std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
      return turn(t[0], t[1], points[s], statistics) > 0 &&
             turn(t[1], t[2], points[s], statistics) > 0 &&
             turn(t[2], t[0], points[s], statistics) > 0;
    });
    if (!is_inner) left.push_back(s);
  }
  statistics.points_discarded += candidates.size() - left.size();
  return left;
}

}  // namespace carpus::hull
