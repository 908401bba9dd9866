// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The farthest two of the axes' extremes; 2. the extreme farthest from their line; 3. the
// extreme farthest from the plane. "Farthest" is rounded and only a good choice; that the choice is
// not degenerate is checked exactly, and any point that is not is searched otherwise.
#include "hull/detail/input_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "geometry/predicates.hpp"
#include "hull/detail/extreme_points.hpp"
#include "hull/detail/orientation.hpp"

namespace carpus::hull {
namespace {

HullStatus name_bad_coordinate(std::span<const Vec3> points) {
  return std::all_of(points.begin(), points.end(), is_finite) ? HullStatus::ScaleRange
                                                              : HullStatus::NotFinite;
}

using Extremes = std::array<std::uint32_t, 14>;

/// The extreme with the largest `measure`.
template <typename Measure>
std::uint32_t extreme_of_max(std::span<const Vec3> points,
                             const Extremes& extremes,
                             const Measure& measure) {
  return *std::max_element(extremes.begin(), extremes.end(), [&](std::uint32_t i, std::uint32_t j) {
    return measure(points[i]) < measure(points[j]);
  });
}

/// The ends of the longest axis.
std::pair<std::uint32_t, std::uint32_t> far_pair(const Extremes& extremes, const Vec3& extent) {
  const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                           : extent.y >= extent.z                       ? 1
                                                                        : 2;
  return {extremes[2 * axis], extremes[2 * axis + 1]};
}

}  // namespace

StartSimplex find_start_simplex(std::span<const Vec3> points, HullStatistics& statistics) {
  StartSimplex result;
  if (points.size() < 4) return result;
  const ExtremePoints found = find_extremes(points);
  if (!found.are_in_range) {
    result.status = name_bad_coordinate(points);
    return result;
  }
  result.extremes = found.index;
  result.low = found.low;
  result.extent = (found.high - found.low) * (1 + 4 * kRoundoff);
  const auto [ia, ib] = far_pair(result.extremes, result.extent);
  const Vec3 a = points[ia];
  const Vec3 b = points[ib];
  const double size = std::max({result.extent.x, result.extent.y, result.extent.z});
  if (size == 0) {
    result.status = HullStatus::Collinear;
    return result;
  }
  const double scale = 1 / size;  // so that products neither overflow nor underflow
  const Vec3 line = (b - a) * scale;
  std::uint32_t ic = extreme_of_max(points, result.extremes, [&](const Vec3& p) {
    return squared_length(cross(line, (p - a) * scale));
  });
  if (are_collinear(a, b, points[ic])) {
    const auto other = std::find_if(points.begin(), points.end(),
                                    [&](const Vec3& p) { return !are_collinear(a, b, p); });
    if (other == points.end()) {
      result.status = HullStatus::Collinear;
      return result;
    }
    ic = static_cast<std::uint32_t>(other - points.begin());
  }

  const Vec3 c = points[ic];
  const Vec3 normal = cross(line, (c - a) * scale);
  std::uint32_t id = extreme_of_max(points, result.extremes, [&](const Vec3& p) {
    return std::abs(dot(normal, (p - a) * scale));
  });
  int side = counted_orient3d(a, b, c, points[id], statistics);
  for (std::uint32_t i = 0; side == 0 && i < points.size(); ++i) {
    side = counted_orient3d(a, b, c, points[i], statistics);
    id = i;
  }
  if (side == 0) {
    result.status = HullStatus::Coplanar;
    return result;
  }
  result.status = HullStatus::Ok;
  result.corners = side < 0 ? std::array{ia, ib, ic, id} : std::array{ia, ic, ib, id};
  return result;
}

}  // namespace carpus::hull
