// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangle_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace carpus {
namespace {

/// One directed edge with the facet it came from.
struct HalfEdge {
  std::uint32_t to;
  std::uint32_t facet;
};

/// The directed edges of a mesh by the vertex they leave, then by the one they lead to. Linear in
/// the facets where no vertex has many.
class HalfEdges {
 public:
  explicit HalfEdges(const TriangleMesh& mesh)
      : first_(mesh.vertices.size() + 1), edges_(mesh.facets.size() * 3) {
    for (const Triangle& t : mesh.facets) {
      for (const std::uint32_t v : t) ++first_[v + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
      const Triangle& t = mesh.facets[f];
      for (std::size_t i = 0; i < 3; ++i) edges_[next[t[i]]++] = {t[(i + 1) % 3], f};
    }
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      std::sort(edges_.begin() + offset(v), edges_.begin() + offset(v + 1), leads_before);
    }
  }

  [[nodiscard]] std::span<const HalfEdge> out_of(std::uint32_t v) const {
    return {edges_.begin() + offset(v), edges_.begin() + offset(v + 1)};
  }
  [[nodiscard]] const HalfEdge* find(std::uint32_t from, std::uint32_t to) const {
    const auto edges = out_of(from);
    const auto it = std::lower_bound(edges.begin(), edges.end(), HalfEdge{to, 0}, leads_before);
    return it != edges.end() && it->to == to ? &*it : nullptr;
  }

 private:
  static bool leads_before(const HalfEdge& a, const HalfEdge& b) { return a.to < b.to; }
  [[nodiscard]] std::ptrdiff_t offset(std::uint32_t v) const {
    return static_cast<std::ptrdiff_t>(first_[v]);
  }

  std::vector<std::size_t> first_;
  std::vector<HalfEdge> edges_;
};

bool each_edge_has_one_twin(const TriangleMesh& mesh, const HalfEdges& edges) {
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto out = edges.out_of(v);
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (i > 0 && out[i - 1].to == out[i].to) return false;
      if (edges.find(out[i].to, v) == nullptr) return false;
    }
  }
  return true;
}

/// In a closed oriented mesh the edges out of a vertex are one per incident facet; walking from
/// facet to facet about the vertex must visit all of them before it returns.
bool each_vertex_has_one_fan(const TriangleMesh& mesh, const HalfEdges& edges) {
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto out = edges.out_of(v);
    if (out.empty()) continue;
    std::uint32_t to = out.front().to;
    std::size_t steps = 0;
    do {
      const Triangle& t = mesh.facets[edges.find(v, to)->facet];
      const std::size_t i = t[0] == v ? 0 : (t[1] == v ? 1 : 2);
      to = t[(i + 2) % 3];
      ++steps;
    } while (to != out.front().to && steps <= out.size());
    if (steps != out.size()) return false;
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
  const HalfEdges edges(mesh);
  if (!each_edge_has_one_twin(mesh, edges)) return SurfaceStatus::OpenOrNonManifold;
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
