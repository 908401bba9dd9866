// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The true height h of a facet's plane is affine: on the ellipsoid with semi-axes s e_i about c it
// is at most h(c) + sqrt(sum of (h(c + s e_i) - h(c - s e_i))^2 / 4). Heights are computed to
// within the plane's bound, which that sum is charged with, so that the proof holds in rounded
// arithmetic (twice: an axis point may be half an extent outside the box for which the bound is
// made). The radius that is used is kMargin smaller than the proven one, far more than the rounding
// of the axis points and of the test.
#include "hull/detail/inner_ellipsoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carpus::hull {
namespace {

constexpr double kMargin = 1e-3;
/// Shrunk this often by half before giving up.
constexpr int kMostTries = 12;

struct AxisPoints {
  std::array<Vec3, 3> low;
  std::array<Vec3, 3> high;
  bool are_precise = true;  ///< not swallowed by the rounding of coordinates far from the origin
};

AxisPoints axis_points(const Vec3& centre, const Vec3& extent, double radius) {
  AxisPoints points;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double step = radius * extent[axis];
    points.low[axis] = points.high[axis] = centre;
    points.low[axis][axis] -= step;
    points.high[axis][axis] += step;
    const double width = points.high[axis][axis] - points.low[axis][axis];
    points.are_precise = points.are_precise && width > 2 * step * (1 - kMargin / 4);
  }
  return points;
}

bool is_below(const OrientedPlane& plane, const Vec3& centre, const AxisPoints& points) {
  double squares = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double half =
        0.5 * std::abs(plane.height(points.high[axis]) - plane.height(points.low[axis])) +
        2 * plane.bound;
    squares += half * half;
  }
  return plane.height(centre) + 2 * plane.bound + std::sqrt(squares) * (1 + 8 * kRoundoff) < 0;
}

}  // namespace

InnerEllipsoid::InnerEllipsoid(const GrownHull& hull, const Vec3& extent)
    : scale_{1 / extent.x, 1 / extent.y, 1 / extent.z} {
  if (!is_finite(scale_) || hull.vertices.empty()) return;
  for (const Vec3& v : hull.vertices) centre_ += v / static_cast<double>(hull.vertices.size());
  // The largest radius by unrounded reasoning, then proven.
  double radius = 0.5;
  for (const GrowingFacet& facet : hull.facets) {
    if (facet.round == kNone) continue;
    const Vec3& n = facet.plane.normal;
    const double slope = length({n.x * extent.x, n.y * extent.y, n.z * extent.z});
    radius = std::min(radius, -facet.plane.height(centre_) / slope);
  }
  for (int tries = 0; tries < kMostTries && radius > kMargin; ++tries) {
    const AxisPoints points = axis_points(centre_, extent, radius);
    const bool is_inside =
        points.are_precise &&
        std::all_of(hull.facets.begin(), hull.facets.end(), [&](const GrowingFacet& facet) {
          return facet.round == kNone || is_below(facet.plane, centre_, points);
        });
    if (is_inside) {
      squared_radius_ = (radius * (1 - kMargin)) * (radius * (1 - kMargin));
      return;
    }
    radius *= tries == 0 ? 1 - kMargin : 0.5;
  }
}

}  // namespace carpus::hull
