// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fields/triangle_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

namespace carpus::fields {
namespace {

double squared_distance_to(const Aabb& box, const Vec3& p) noexcept {
  // One subtraction of each pair is negative or zero unless p is outside on that side.
  const double x = std::max(std::max(box.low.x - p.x, p.x - box.high.x), 0.0);
  const double y = std::max(std::max(box.low.y - p.y, p.y - box.high.y), 0.0);
  const double z = std::max(std::max(box.low.z - p.z, p.z - box.high.z), 0.0);
  return x * x + y * y + z * z;
}

Vec3 nearest_on_edge(const Vec3& a, const Vec3& b, double from_a, double from_b) noexcept {
  // Parameters are measured from both ends, so that the division is by their sum.
  return a + (b - a) * (from_a / (from_a + from_b));
}

}  // namespace

Vec3 nearest_point_on_triangle(const Vec3& p,
                               const Vec3& a,
                               const Vec3& b,
                               const Vec3& c) noexcept {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = dot(ab, ap);
  const double d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp);
  const double d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp);
  const double d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 > 0 && d3 < 0) return nearest_on_edge(a, b, d1, -d3);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 > 0 && d6 < 0) return nearest_on_edge(a, c, d2, -d6);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 > 0 && d5 - d6 > 0) return nearest_on_edge(b, c, d4 - d3, d5 - d6);
  const double total = va + vb + vc;
  if (!(total > 0)) return a;  // no area: its edges were all refused by rounding alone
  return a + ab * (vb / total) + ac * (vc / total);
}

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  slots_.reserve(mesh.facets.size());
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    const Triangle& t = mesh.facets[f];
    slots_.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], f});
  }
  if (slots_.empty()) return;
  build(0, static_cast<std::uint32_t>(slots_.size()));
  slot_of_facet_.resize(slots_.size());
  for (std::uint32_t i = 0; i < slots_.size(); ++i) slot_of_facet_[slots_[i].facet] = i;
}

void TriangleTree::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Aabb box;
  Aabb centres;
  const auto centre = [](const Slot& s) { return s.a + s.b + s.c; };  // three times the centre
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& v : {slots_[i].a, slots_[i].b, slots_[i].c}) box.include(v);
    centres.include(centre(slots_[i]));
  }
  nodes_[index].box = box;
  if (end - begin <= kLeafSize) {
    nodes_[index].first = begin;
    nodes_[index].count = end - begin;
    return;
  }
  const Vec3 extent = centres.extent();
  const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                           : extent.y >= extent.z                       ? 1
                                                                        : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(slots_.begin() + begin, slots_.begin() + middle, slots_.begin() + end,
                   [&](const Slot& s, const Slot& t) {
                     const double cs = centre(s)[axis];
                     const double ct = centre(t)[axis];
                     return cs != ct ? cs < ct : s.facet < t.facet;
                   });
  build(begin, middle);
  nodes_[index].first = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

void TriangleTree::improve(const Slot& slot, const Vec3& p, NearestPoint& best) noexcept {
  const Vec3 q = nearest_point_on_triangle(p, slot.a, slot.b, slot.c);
  const double d = squared_length(p - q);
  if (d < best.squared_distance) best = {q, d, slot.facet};
}

void TriangleTree::visit_leaf(const Node& leaf, const Vec3& p, NearestPoint& best) const noexcept {
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) improve(slots_[i], p, best);
}

std::optional<NearestPoint> TriangleTree::nearest(
    const Vec3& p,
    double limit_mm,
    std::optional<std::uint32_t> hint) const noexcept {
  if (nodes_.empty()) return std::nullopt;
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  NearestPoint best{{}, limit_mm * limit_mm, kNone};
  if (hint) improve(slots_[slot_of_facet_[*hint]], p, best);

  std::array<std::pair<std::uint32_t, double>, kMaxDepth> open;
  std::size_t open_count = 0;
  std::uint32_t at = 0;
  double at_distance = squared_distance_to(nodes_[0].box, p);
  while (true) {
    if (at_distance < best.squared_distance) {
      const Node& node = nodes_[at];
      if (node.count == 0) {
        std::uint32_t near = at + 1;
        std::uint32_t far = node.first;
        double near_distance = squared_distance_to(nodes_[near].box, p);
        double far_distance = squared_distance_to(nodes_[far].box, p);
        if (far_distance < near_distance) {
          std::swap(near, far);
          std::swap(near_distance, far_distance);
        }
        if (far_distance < best.squared_distance) open[open_count++] = {far, far_distance};
        at = near;
        at_distance = near_distance;
        continue;
      }
      visit_leaf(node, p, best);
    }
    if (open_count == 0) break;
    std::tie(at, at_distance) = open[--open_count];
  }
  if (best.facet == kNone) return std::nullopt;
  return best;
}

}  // namespace carpus::fields
