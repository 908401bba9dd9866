// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "hull/detail/face_polygon.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

#include "hull/detail/orientation.hpp"

namespace carpus::hull {
namespace {

bool is_before(const Vec3& a, const Vec3& b) noexcept {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
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
  // Lexicographic order of coplanar points is that along some line of their plane.
  std::vector<std::uint32_t> sweep(on_plane.begin(), on_plane.end());
  std::sort(sweep.begin(), sweep.end(), [&](std::uint32_t i, std::uint32_t j) {
    return points[i] == points[j] ? i < j : is_before(points[i], points[j]);
  });
  const auto is_same = [&](std::uint32_t i, std::uint32_t j) { return points[i] == points[j]; };
  sweep.erase(std::unique(sweep.begin(), sweep.end(), is_same), sweep.end());

  std::vector<std::uint32_t> polygon;
  const auto add_chain = [&](auto begin, auto end) {  // without its last point
    const std::size_t first = polygon.size();
    for (auto s = begin; s != end; ++s) {
      // Seen from above, s to the right of p -> q means orient3d(p, q, s, below) > 0.
      while (polygon.size() >= first + 2 &&
             counted_orient3d(points[polygon[polygon.size() - 2]], points[polygon.back()],
                              points[*s], below, statistics) >= 0) {
        polygon.pop_back();
      }
      polygon.push_back(*s);
    }
    polygon.pop_back();
  };
  add_chain(sweep.begin(), sweep.end());
  add_chain(sweep.rbegin(), sweep.rend());
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
