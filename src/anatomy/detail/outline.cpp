// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "anatomy/detail/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace carpus::detail {
namespace {

struct PlanePoint {
  double u = 0.0;
  double v = 0.0;
};

/// Of one facet; the inside is on its left.
struct Segment {
  PlanePoint from;
  PlanePoint to;
  std::size_t outline = 0;
};

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Joins segments that meet on an edge.
class Outlines {
 public:
  std::size_t of_edges(const Edge& a, const Edge& b) { return joined(number_of(a), number_of(b)); }
  std::size_t root(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

 private:
  std::size_t number_of(const Edge& edge) {
    const auto [found, is_new] = numbers_.try_emplace(edge, parents_.size());
    if (is_new) parents_.push_back(parents_.size());
    return found->second;
  }
  std::size_t joined(std::size_t a, std::size_t b) {
    a = root(a);
    parents_[root(b)] = a;
    return a;
  }
  std::map<Edge, std::size_t> numbers_;
  std::vector<std::size_t> parents_;
};

/// Twice the area, the first moments, how often it goes around the origin, and how near it comes.
struct Outline {
  double twice_area = 0.0;
  PlanePoint moment;
  double winding = 0.0;
  double nearest = 1e300;

  void add(const Segment& s) {
    const double z = s.from.u * s.to.v - s.to.u * s.from.v;
    twice_area += z;
    moment.u += (s.from.u + s.to.u) * z;
    moment.v += (s.from.v + s.to.v) * z;
    winding += std::atan2(z, s.from.u * s.to.u + s.from.v * s.to.v);
    nearest = std::min(nearest, std::hypot(s.from.u, s.from.v));
  }
  [[nodiscard]] bool holds_origin() const { return winding > 1.0; }
};

}  // namespace

BoneSection outline_around(const TriangleMesh& mesh, const Vec3& point, const Vec3& normal) {
  const Vec3 u = any_perpendicular(normal);
  const Vec3 v = cross(normal, u);
  std::vector<double> height(mesh.vertices.size());
  std::transform(mesh.vertices.begin(), mesh.vertices.end(), height.begin(),
                 [&](const Vec3& vertex) { return dot(vertex - point, normal); });
  const auto crossing = [&](std::uint32_t below, std::uint32_t above) {
    const double share = height[below] / (height[below] - height[above]);
    const Vec3 p = mesh.vertices[below] + (mesh.vertices[above] - mesh.vertices[below]) * share;
    return PlanePoint{dot(p - point, u), dot(p - point, v)};
  };
  Outlines outlines;
  std::vector<Segment> segments;
  for (const Triangle& f : mesh.facets) {
    // A vertex in the plane counts as above it: every facet is crossed twice or not at all.
    const std::array<bool, 3> above{height[f[0]] >= 0, height[f[1]] >= 0, height[f[2]] >= 0};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    Segment segment;
    std::array<Edge, 2> edges;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (above[i] == above[j]) continue;
      const bool goes_up = above[j];
      const PlanePoint p = goes_up ? crossing(f[i], f[j]) : crossing(f[j], f[i]);
      // Seen from outside, counter-clockwise: where the boundary goes up the inside's outline ends.
      (goes_up ? segment.to : segment.from) = p;
      edges[goes_up ? 1 : 0] = edge_of(f[i], f[j]);
    }
    segment.outline = outlines.of_edges(edges[0], edges[1]);
    segments.push_back(segment);
  }
  std::map<std::size_t, Outline> found;
  for (const Segment& segment : segments) found[outlines.root(segment.outline)].add(segment);
  const Outline* best = nullptr;
  for (const auto& [root, outline] : found) {
    if (best == nullptr || std::pair(!outline.holds_origin(), outline.nearest) <
                               std::pair(!best->holds_origin(), best->nearest)) {
      best = &outline;
    }
  }
  BoneSection section;
  if (best == nullptr || !(std::abs(best->twice_area) > 0.0)) return section;
  section.area_mm2 = 0.5 * std::abs(best->twice_area);
  const double scale = 1.0 / (3.0 * best->twice_area);
  section.centroid = point + u * (best->moment.u * scale) + v * (best->moment.v * scale);
  return section;
}

}  // namespace carpus::detail
