// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/face_polygon.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

#include "core/check.hpp"
#include "hull/detail/orientation.hpp"

namespace carpus::hull {
namespace {

bool is_before(const Vec3& a, const Vec3& b) noexcept {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Of q and s on one ray from p, whether s is farther; compares coordinates, hence exact.
bool is_beyond(const Vec3& p, const Vec3& q, const Vec3& s) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (q[axis] != p[axis]) return q[axis] > p[axis] ? s[axis] > q[axis] : s[axis] < q[axis];
  }
  return false;
}

}  // namespace

std::vector<std::uint32_t> distinct_points(std::span<const Vec3> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return points[i] == points[j] ? i < j : is_before(points[i], points[j]);
  });
  const auto last = std::unique(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return points[i] == points[j];
  });
  order.erase(last, order.end());
  std::sort(order.begin(), order.end());
  return order;
}

std::vector<std::uint32_t> face_polygon(std::span<const Vec3> points,
                                        std::span<const std::uint32_t> on_plane,
                                        const Vec3& below,
                                        HullStatistics& statistics) {
  // The first in lexicographic order is a corner in any plane.
  const std::uint32_t start = *std::min_element(
      on_plane.begin(), on_plane.end(),
      [&](std::uint32_t i, std::uint32_t j) { return is_before(points[i], points[j]); });
  std::vector<std::uint32_t> polygon;
  std::uint32_t at = start;
  do {
    CARPUS_CHECK(polygon.size() <= on_plane.size());
    polygon.push_back(at);
    std::uint32_t next = at;
    for (const std::uint32_t s : on_plane) {
      if (s == at) continue;
      if (next == at) {
        next = s;
        continue;
      }
      // Seen from above, s to the right of at -> next means orient3d(at, next, s, below) > 0.
      const int side = counted_orient3d(points[at], points[next], points[s], below, statistics);
      if (side > 0 || (side == 0 && is_beyond(points[at], points[next], points[s]))) next = s;
    }
    at = next;
  } while (at != start);
  return polygon;
}

void add_fan(std::span<const std::uint32_t> polygon,
             std::vector<Triangle>& facets,
             HullStatistics& statistics) {
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    facets.push_back({polygon[0], polygon[i], polygon[i + 1]});
    ++statistics.facets_created;
  }
}

}  // namespace carpus::hull
