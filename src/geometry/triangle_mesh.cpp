// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangle_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace carpus {
namespace {

/// One directed edge with the facet it came from.
struct HalfEdge {
  std::uint32_t from;
  std::uint32_t to;
  std::uint32_t facet;
};

std::vector<HalfEdge> sorted_half_edges(const TriangleMesh& mesh) {
  std::vector<HalfEdge> edges;
  edges.reserve(mesh.facets.size() * 3);
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    const Triangle& t = mesh.facets[f];
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({t[i], t[(i + 1) % 3], f});
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  });
  return edges;
}

bool each_edge_has_one_twin(const std::vector<HalfEdge>& edges) {
  const auto before = [](const HalfEdge& a, const std::pair<std::uint32_t, std::uint32_t>& key) {
    return std::pair(a.from, a.to) < key;
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const HalfEdge& e = edges[i];
    if (i > 0 && edges[i - 1].from == e.from && edges[i - 1].to == e.to) return false;
    const auto twin = std::lower_bound(edges.begin(), edges.end(), std::pair(e.to, e.from), before);
    if (twin == edges.end() || twin->from != e.to || twin->to != e.from) return false;
  }
  return true;
}

/// In a closed oriented mesh the edges out of a vertex are one per incident facet; walking from
/// facet to facet about the vertex must visit all of them before it returns.
bool each_vertex_has_one_fan(const TriangleMesh& mesh, const std::vector<HalfEdge>& edges) {
  const auto facet_of = [&](std::uint32_t from, std::uint32_t to) {
    const auto it =
        std::lower_bound(edges.begin(), edges.end(), std::pair(from, to),
                         [](const HalfEdge& a, const std::pair<std::uint32_t, std::uint32_t>& key) {
                           return std::pair(a.from, a.to) < key;
                         });
    return it->facet;
  };
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    while (end < edges.size() && edges[end].from == edges[begin].from) ++end;
    const std::uint32_t v = edges[begin].from;
    std::uint32_t to = edges[begin].to;
    std::size_t steps = 0;
    do {
      const Triangle& t = mesh.facets[facet_of(v, to)];
      const std::size_t i = t[0] == v ? 0 : (t[1] == v ? 1 : 2);
      to = t[(i + 2) % 3];
      ++steps;
    } while (to != edges[begin].to && steps <= end - begin);
    if (steps != end - begin) return false;
    begin = end;
  }
  return true;
}

}  // namespace

SurfaceStatus check_surface(const TriangleMesh& mesh) {
  if (mesh.facets.empty()) return SurfaceStatus::Empty;
  for (const Triangle& t : mesh.facets) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return SurfaceStatus::IndexOutOfRange;
    for (const std::uint32_t v : t) {
      if (v >= mesh.vertices.size()) return SurfaceStatus::IndexOutOfRange;
    }
  }
  if (!std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_finite))
    return SurfaceStatus::NotFinite;
  const std::vector<HalfEdge> edges = sorted_half_edges(mesh);
  if (!each_edge_has_one_twin(edges)) return SurfaceStatus::OpenOrNonManifold;
  if (!each_vertex_has_one_fan(mesh, edges)) return SurfaceStatus::PinchedVertex;
  return SurfaceStatus::Ok;
}

double volume_of(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  const Vec3 o = mesh.vertices.front();  // near the surface, so that far-away bodies lose no digits
  double six_volumes = 0.0;
  for (const Triangle& t : mesh.facets) {
    six_volumes +=
        dot(mesh.vertices[t[0]] - o, cross(mesh.vertices[t[1]] - o, mesh.vertices[t[2]] - o));
  }
  return six_volumes / 6.0;
}

double area_of(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    area += 0.5 * length(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
  }
  return area;
}

Vec3 centroid_of(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return {};
  const Vec3 o = mesh.vertices.front();
  double six_volumes = 0.0;
  Vec3 sum{};
  for (const Triangle& t : mesh.facets) {
    const Vec3 a = mesh.vertices[t[0]] - o;
    const Vec3 b = mesh.vertices[t[1]] - o;
    const Vec3 c = mesh.vertices[t[2]] - o;
    const double v = dot(a, cross(b, c));
    six_volumes += v;
    sum += (a + b + c) * (v / 4.0);
  }
  return six_volumes == 0.0 ? o : o + sum / six_volumes;
}

}  // namespace carpus
