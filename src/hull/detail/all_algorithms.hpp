// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every algorithm of space side by side, and whether they agree; for tests and fuzzing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "geometry/predicates.hpp"
#include "geometry/tolerance.hpp"
#include "hull/brute_force_hull.hpp"
#include "hull/chan_hull.hpp"
#include "hull/detail/hull_verification.hpp"
#include "hull/fast_hull.hpp"
#include "hull/gift_wrapping.hpp"
#include "hull/hybrid_hull.hpp"
#include "hull/quickhull.hpp"

namespace carpus::hull {

struct Algorithm {
  const char* name;
  HullResult (*build)(std::span<const Vec3>, const HullOptions&);
  std::size_t most_points;
};
inline constexpr std::size_t kAnyNumber = std::numeric_limits<std::size_t>::max();
inline const std::array kAlgorithms{
    Algorithm{"quickhull", build_convex_hull, kAnyNumber},
    Algorithm{"fast",
              [](std::span<const Vec3> p, const HullOptions&) { return build_fast_hull(p); },
              kAnyNumber},
    Algorithm{"gift_wrapping", build_hull_by_gift_wrapping, kAnyNumber},
    Algorithm{"chan", build_hull_by_chan, kAnyNumber},
    Algorithm{"hybrid", build_hull_by_hybrid, kAnyNumber},
    Algorithm{"brute_force", build_hull_by_brute_force, 16}};  // O(n^4)

/// By definition, for points of any kind.
[[nodiscard]] inline HullStatus status_of(const std::vector<Vec3>& points) {
  if (points.size() < 4) return HullStatus::TooFewPoints;
  if (!std::all_of(points.begin(), points.end(), is_finite)) return HullStatus::NotFinite;
  const auto is_in_range = [](double c) {
    return c == 0 || (std::abs(c) <= kLargestCoordinate && std::abs(c) >= kSmallestCoordinate);
  };
  if (!std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
        return is_in_range(p.x) && is_in_range(p.y) && is_in_range(p.z);
      })) {
    return HullStatus::ScaleRange;
  }
  const Vec3& a = points[0];
  const auto b = std::find_if(points.begin(), points.end(), [&](const Vec3& p) { return p != a; });
  if (b == points.end()) return HullStatus::Collinear;
  const auto c = std::find_if(points.begin(), points.end(),
                              [&](const Vec3& p) { return !are_collinear(a, *b, p); });
  if (c == points.end()) return HullStatus::Collinear;
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return orient3d_exact(a, *b, *c, p) == 0; })
             ? HullStatus::Coplanar
             : HullStatus::Ok;
}

/// Empty if every algorithm gives what an independent check accepts, all the same bytes unless
/// there are duplicates; else what is wrong.
[[nodiscard]] inline std::string check_all(const std::vector<Vec3>& points, bool has_duplicates) {
  const HullStatus expected = status_of(points);
  HullResult first;
  for (const Algorithm& algorithm : kAlgorithms) {
    if (points.size() > algorithm.most_points) continue;
    HullResult result = algorithm.build(points, {});
    const std::string name = algorithm.name;
    if (result.status != expected) return name + ": another status";
    if (expected != HullStatus::Ok) {
      if (!result.polytope.facets.empty()) return name + ": a polytope without a hull";
      continue;
    }
    const bool is_same = first.status == HullStatus::Ok &&
                         result.polytope.vertices == first.polytope.vertices &&
                         result.polytope.input_indices == first.polytope.input_indices &&
                         result.polytope.facets == first.polytope.facets &&
                         result.polytope.neighbours == first.polytope.neighbours;
    if (is_same) continue;
    if (first.status == HullStatus::Ok && !has_duplicates) return name + ": other bytes";
    if (const std::string wrong = verify_hull(result.polytope, points); !wrong.empty()) {
      return name + ": " + wrong;
    }
    if (first.status != HullStatus::Ok) first = std::move(result);
  }
  return "";
}

}  // namespace carpus::hull
