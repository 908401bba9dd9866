// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/skin_rims.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

namespace carpus::reconstruct {
namespace {

constexpr double kLeastRimMm2 = 150;
constexpr double kFlatMm = 2;

bool is_flat(const Rim& rim) {
  return std::all_of(rim.corners.begin(), rim.corners.end(),
                     [&](const Vec3& c) { return std::abs(rim.beyond(c)) < kFlatMm; });
}

/// From corner to corner along edges without a twin.
std::map<std::uint32_t, std::uint32_t> open_edges(const TriangleMesh& skin) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : skin.facets) {
    for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) next[from] = to;
  }
  return next;
}

}  // namespace

std::vector<Rim> rims_of(const TriangleMesh& skin) {
  Vec3 inside;
  for (const Vec3& v : skin.vertices) inside += v / static_cast<double>(skin.vertices.size());
  auto next = open_edges(skin);
  std::vector<Rim> rims;
  while (!next.empty()) {
    Rim rim;
    auto at = next.begin();
    while (at != next.end()) {
      rim.corners.push_back(skin.vertices[at->first]);
      const auto to = at->second;
      next.erase(at);
      at = next.find(to);
    }
    const std::size_t count = rim.corners.size();
    for (const Vec3& c : rim.corners) rim.middle += c / static_cast<double>(count);
    // Twice the area, as a vector: normal to the plane.
    Vec3 area;
    for (std::size_t i = 0; i < count; ++i) {
      area += cross(rim.corners[i] - rim.middle, rim.corners[(i + 1) % count] - rim.middle);
    }
    rim.outwards = normalized_or(area, {});
    if (dot(rim.middle - inside, rim.outwards) < 0) rim.outwards = -rim.outwards;
    if (length(area) > 2 * kLeastRimMm2 && is_flat(rim)) rims.push_back(std::move(rim));
  }
  return rims;
}

RimOutline::RimOutline(const Rim& rim, const Vec3& way)
    : rim_(rim),
      way_(way),
      across_(any_perpendicular(rim.outwards)),
      up_(cross(rim.outwards, across_)) {
  for (const Vec3& c : rim.corners) flat_.push_back(flat(c));
}

std::pair<double, double> RimOutline::flat(const Vec3& p) const {
  return {dot(p - rim_.middle, across_), dot(p - rim_.middle, up_)};
}

double RimOutline::distance_to(const Vec3& p, double widened) const {
  const double t = rim_.beyond(p) / std::max(0.2, dot(way_, rim_.outwards));
  const auto [x0, y0] = flat(p - way_ * t);
  const double x = x0 / widened;
  const double y = y0 / widened;
  double least = 1e18;
  bool is_in = false;
  for (std::size_t i = 0, j = flat_.size() - 1; i < flat_.size(); j = i++) {
    const auto [ax, ay] = flat_[i];
    const auto [bx, by] = flat_[j];
    const double ex = bx - ax;
    const double ey = by - ay;
    const double s =
        std::clamp(((x - ax) * ex + (y - ay) * ey) / std::max(1e-12, ex * ex + ey * ey), 0.0, 1.0);
    const double dx = x - ax - s * ex;
    const double dy = y - ay - s * ey;
    least = std::min(least, dx * dx + dy * dy);
    if ((ay > y) != (by > y) && x < ex * (y - ay) / ey + ax) is_in = !is_in;
  }
  return (is_in ? -1 : 1) * std::sqrt(least) * widened;
}

}  // namespace carpus::reconstruct
