// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/closest/expanding_polytope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/tolerance.hpp"

namespace carpus::survey {
namespace {

/// Twice a triangle's area over the squares of its edges; below, its normal is rounding.
constexpr double kFlatTriangle = 1e-13;

}  // namespace

ExpandingPolytope::ExpandingPolytope(std::size_t most_corners) : most_corners_(most_corners) {
  const std::size_t most_triangles = 2 * most_corners;
  corners_.reserve(most_corners);
  triangles_.reserve(most_triangles);
  heights_.reserve(most_triangles);
  is_below_.reserve(most_triangles);
  below_.reserve(most_triangles);
  horizon_.reserve(most_triangles);
  edge_at_.resize(most_corners);
  fan_.reserve(most_triangles);
}

void ExpandingPolytope::clear() noexcept {
  corners_.clear();
  triangles_.clear();
  heights_.clear();
  is_below_.clear();
}

bool ExpandingPolytope::make_plane(Triangle& triangle) const noexcept {
  const Vec3& a = corners_[triangle.corners[0]].at;
  const Vec3& b = corners_[triangle.corners[1]].at;
  const Vec3& c = corners_[triangle.corners[2]].at;
  const Vec3 e = b - a;
  const Vec3 f = c - a;
  const Vec3 n = cross(e, f);
  const double area = length(n);
  if (!(area > kFlatTriangle * (dot(e, e) + dot(f, f)))) return false;
  triangle.normal = n / area;
  triangle.height =
      std::min({dot(triangle.normal, a), dot(triangle.normal, b), dot(triangle.normal, c)});
  return true;
}

bool ExpandingPolytope::start(const std::array<DifferencePoint, 4>& corners) noexcept {
  clear();
  corners_.assign(corners.begin(), corners.end());
  const Vec3& a = corners[0].at;
  const double volume = dot(cross(corners[1].at - a, corners[2].at - a), corners[3].at - a);
  if (volume > 0) std::swap(corners_[1], corners_[2]);  // corner 3 below the triangle 0 1 2
  constexpr std::array<std::array<std::uint16_t, 3>, 4> kCorners{
      {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  constexpr std::array<std::array<std::uint16_t, 3>, 4> kNeighbours{
      {{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}}};
  for (std::size_t t = 0; t < 4; ++t) {
    Triangle triangle{{}, 0, kCorners[t], kNeighbours[t]};
    if (!make_plane(triangle)) {
      clear();
      return false;
    }
    triangles_.push_back(triangle);
    heights_.push_back(triangle.height);
    is_below_.push_back(0);
  }
  return volume != 0;
}

bool ExpandingPolytope::place(const PosedPair& pair) noexcept {
  for (DifferencePoint& corner : corners_) corner = pair.point(corner.first, corner.second);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!make_plane(triangles_[t])) return false;
    heights_[t] = triangles_[t].height;
  }
  return true;
}

std::uint16_t ExpandingPolytope::lowest() const noexcept {
  std::size_t best = 0;
  for (std::size_t t = 1; t < heights_.size(); ++t) {
    if (heights_[t] < heights_[best]) best = t;
  }
  return static_cast<std::uint16_t>(best);
}

void ExpandingPolytope::find_below(const Vec3& point,
                                   std::uint16_t from,
                                   double coplanar_mm) noexcept {
  below_.clear();
  horizon_.clear();
  below_.push_back(from);
  is_below_[from] = 1;
  for (std::size_t next = 0; next < below_.size(); ++next) {
    const Triangle& here = triangles_[below_[next]];
    for (const std::uint16_t t : here.neighbours) {
      if (is_below_[t] != 0) continue;
      const Vec3& at = corners_[triangles_[t].corners[0]].at;
      if (!(dot(triangles_[t].normal, point - at) > -coplanar_mm)) continue;
      is_below_[t] = 1;
      below_.push_back(t);
    }
  }
  for (const std::uint16_t t : below_) {
    const Triangle& here = triangles_[t];
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_below_[here.neighbours[i]] != 0) continue;
      horizon_.push_back({here.corners[i], here.corners[(i + 1) % 3], here.neighbours[i]});
    }
  }
}

bool ExpandingPolytope::order_horizon() noexcept {
  for (const HorizonEdge& edge : horizon_) edge_at_[edge.from] = kNone;
  for (std::size_t i = 0; i < horizon_.size(); ++i) {
    if (edge_at_[horizon_[i].from] != kNone) return false;  // a corner twice: not a simple loop
    edge_at_[horizon_[i].from] = static_cast<std::uint16_t>(i);
  }
  for (std::size_t i = 0; i + 1 < horizon_.size(); ++i) {
    // Each edge's end is the start of one: the ends are a permutation of the starts.
    const std::uint16_t next = edge_at_[horizon_[i].to];
    if (next == kNone || next <= i) return false;  // closed too soon: two loops
    std::swap(horizon_[i + 1], horizon_[next]);
    edge_at_[horizon_[next].from] = next;
    edge_at_[horizon_[i + 1].from] = static_cast<std::uint16_t>(i + 1);
  }
  return horizon_.size() >= 3 && horizon_.back().to == horizon_.front().from;
}

bool ExpandingPolytope::make_fan(std::uint16_t apex) noexcept {
  fan_.clear();
  for (const HorizonEdge& edge : horizon_) {
    Triangle triangle{{}, 0, {edge.from, edge.to, apex}, {edge.outside, kNone, kNone}};
    if (!make_plane(triangle)) return false;
    fan_.push_back(triangle);
  }
  return true;
}

void ExpandingPolytope::remove(std::uint16_t hole) noexcept {
  const auto last = static_cast<std::uint16_t>(triangles_.size() - 1);
  if (hole != last) {
    for (const std::uint16_t t : triangles_[last].neighbours) {
      std::replace(triangles_[t].neighbours.begin(), triangles_[t].neighbours.end(), last, hole);
    }
    triangles_[hole] = triangles_[last];
    heights_[hole] = heights_[last];
    is_below_[hole] = 0;
  }
  triangles_.pop_back();
  heights_.pop_back();
  is_below_.pop_back();
}

void ExpandingPolytope::replace_below() noexcept {
  // The fan takes the places of what it replaces, then new ones; corners that vanish below it leave
  // places over, which the last triangles take.
  const std::size_t before = triangles_.size();
  std::sort(below_.begin(), below_.end());
  const auto place_of = [&](std::size_t i) {
    return static_cast<std::uint16_t>(i < below_.size() ? below_[i] : before + i - below_.size());
  };
  if (fan_.size() > below_.size()) {
    const std::size_t size = before + fan_.size() - below_.size();
    triangles_.resize(size);
    heights_.resize(size);
    is_below_.resize(size);
  }
  const std::size_t n = fan_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint16_t t = place_of(i);
    Triangle& triangle = fan_[i];
    triangle.neighbours[1] = place_of((i + 1) % n);
    triangle.neighbours[2] = place_of((i + n - 1) % n);
    Triangle& outside = triangles_[triangle.neighbours[0]];
    for (std::size_t k = 0; k < 3; ++k) {
      if (outside.corners[k] == triangle.corners[1] &&
          outside.corners[(k + 1) % 3] == triangle.corners[0]) {
        outside.neighbours[k] = t;
      }
    }
    triangles_[t] = triangle;
    heights_[t] = triangle.height;
    is_below_[t] = 0;
  }
  for (std::size_t i = below_.size(); i > n; --i) remove(below_[i - 1]);
}

ExpandingPolytope::Growth ExpandingPolytope::grow(const DifferencePoint& point,
                                                  std::uint16_t from,
                                                  double coplanar_mm) noexcept {
  if (corners_.size() >= most_corners_) return Growth::Full;
  find_below(point.at, from, coplanar_mm);
  corners_.push_back(point);
  const auto apex = static_cast<std::uint16_t>(corners_.size() - 1);
  if (!order_horizon() || !make_fan(apex)) {
    for (const std::uint16_t t : below_) is_below_[t] = 0;
    corners_.pop_back();
    return Growth::Broken;
  }
  replace_below();
  return Growth::Grown;
}

}  // namespace carpus::survey
