// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/ray_tree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace carpus::arthroscopy {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kMaxDepth = 64;  // halving 2^32 facets takes 32 levels

/// Slabs; the segment's ends count as in.
bool reaches(const Aabb& box, const Vec3& from, const Vec3& way) noexcept {
  double low = 0;
  double high = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    if (way[a] == 0) {
      if (from[a] < box.low[a] || from[a] > box.high[a]) return false;
      continue;
    }
    const double first = (box.low[a] - from[a]) / way[a];
    const double last = (box.high[a] - from[a]) / way[a];
    low = std::max(low, std::min(first, last));
    high = std::min(high, std::max(first, last));
    if (low > high) return false;
  }
  return true;
}

}  // namespace

bool meets(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 way = to - from;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 p = cross(way, ac);
  const double det = dot(ab, p);
  if (det == 0) return false;
  const Vec3 s = from - a;
  const double u = dot(s, p) / det;
  if (!(u >= 0 && u <= 1)) return false;
  const Vec3 q = cross(s, ab);
  const double v = dot(way, q) / det;
  if (!(v >= 0 && u + v <= 1)) return false;
  const double t = dot(ac, q) / det;
  return t >= 0 && t <= 1;
}

RayTree::RayTree(const TriangleMesh& mesh) {
  slots_.reserve(mesh.facets.size());
  for (const Triangle& f : mesh.facets) {
    slots_.push_back({mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]});
  }
  if (!slots_.empty()) build(0, static_cast<std::uint32_t>(slots_.size()));
}

void RayTree::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  Aabb box;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& v : {slots_[i].a, slots_[i].b, slots_[i].c}) box.include(v);
  }
  nodes_[at].box = box;
  if (end - begin <= kLeafSize) {
    nodes_[at].first = begin;
    nodes_[at].count = end - begin;
    return;
  }
  const Vec3 extent = box.extent();
  const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                           : extent.y >= extent.z                       ? 1
                                                                        : 2;
  const auto middle_of = [axis](const Slot& s) { return s.a[axis] + s.b[axis] + s.c[axis]; };
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(slots_.begin() + begin, slots_.begin() + middle, slots_.begin() + end,
                   [&](const Slot& l, const Slot& r) { return middle_of(l) < middle_of(r); });
  build(begin, middle);
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

bool RayTree::is_between(const Vec3& from, const Vec3& to) const noexcept {
  if (nodes_.empty()) return false;
  const Vec3 way = to - from;
  std::array<std::uint32_t, kMaxDepth> open{};
  std::size_t count = 0;
  open[count++] = 0;
  while (count > 0) {
    const std::uint32_t at = open[--count];
    const Node& node = nodes_[at];
    if (!reaches(node.box, from, way)) continue;
    if (node.count == 0) {
      open[count++] = node.first;
      open[count++] = at + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (meets(from, to, slots_[i].a, slots_[i].b, slots_[i].c)) return true;
    }
  }
  return false;
}

}  // namespace carpus::arthroscopy
