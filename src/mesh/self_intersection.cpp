// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/self_intersection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/aabb.hpp"
#include "geometry/predicates.hpp"

namespace carpus::mesh {
namespace {

/// A cell's side against the mean side of a facet's box.
constexpr double kCellPerFacet = 1.5;
/// Cells along the longest side of the surface, at most.
constexpr int kMostCells = 256;

Aabb box_of(const TriangleMesh& mesh, std::size_t facet) {
  Aabb box;
  for (const std::uint32_t v : mesh.facets[facet]) box.include(mesh.vertices[v]);
  return box;
}

bool overlap(const Aabb& a, const Aabb& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// Whether the inside of the segment from p to q passes through the inside of the facet.
bool crosses(const TriangleMesh& mesh, std::uint32_t p, std::uint32_t q, const Triangle& facet) {
  const Vec3& from = mesh.vertices[p];
  const Vec3& to = mesh.vertices[q];
  const Vec3& a = mesh.vertices[facet[0]];
  const Vec3& b = mesh.vertices[facet[1]];
  const Vec3& c = mesh.vertices[facet[2]];
  if (orient3d(a, b, c, from) * orient3d(a, b, c, to) >= 0) return false;
  const int side = orient3d(from, to, a, b);
  return side != 0 && orient3d(from, to, b, c) == side && orient3d(from, to, c, a) == side;
}

/// Edges of `facet` without a corner in `other` against it.
bool an_edge_crosses(const TriangleMesh& mesh, const Triangle& facet, const Triangle& other) {
  const auto is_shared = [&](std::uint32_t v) {
    return std::find(other.begin(), other.end(), v) != other.end();
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t p = facet[k];
    const std::uint32_t q = facet[(k + 1) % 3];
    if (!is_shared(p) && !is_shared(q) && crosses(mesh, p, q, other)) return true;
  }
  return false;
}

bool facets_cross(const TriangleMesh& mesh, const Triangle& s, const Triangle& t) {
  const auto shared = std::count_if(s.begin(), s.end(), [&](std::uint32_t v) {
    return std::find(t.begin(), t.end(), v) != t.end();
  });
  if (shared > 1) return false;
  return an_edge_crosses(mesh, s, t) || an_edge_crosses(mesh, t, s);
}

/// Facets by the cells that their boxes meet.
class Cells {
 public:
  Cells(const TriangleMesh& mesh, const std::vector<Aabb>& boxes) {
    Aabb all;
    double side = 0;
    for (const Aabb& box : boxes) {
      all.include(box.low);
      all.include(box.high);
      const Vec3 e = box.extent();
      side += std::max({e.x, e.y, e.z});
    }
    low_ = all.low;
    const Vec3 extent = all.extent();
    const double longest = std::max({extent.x, extent.y, extent.z});
    side_ =
        std::max(kCellPerFacet * side / static_cast<double>(boxes.size()), longest / kMostCells);
    if (!(side_ > 0)) side_ = 1;
    for (std::size_t a = 0; a < 3; ++a) count_[a] = cell_of(all.high, a) + 1;
    facets_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
                   static_cast<std::size_t>(count_[2]));
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      visit(boxes[f], [&](std::vector<std::uint32_t>& cell) {
        cell.push_back(static_cast<std::uint32_t>(f));
      });
    }
  }
  template <typename Visit>
  void visit(const Aabb& box, const Visit& act) {
    for (int z = cell_of(box.low, 2); z <= cell_of(box.high, 2); ++z) {
      for (int y = cell_of(box.low, 1); y <= cell_of(box.high, 1); ++y) {
        for (int x = cell_of(box.low, 0); x <= cell_of(box.high, 0); ++x) {
          act(facets_[static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x)]);
        }
      }
    }
  }

 private:
  [[nodiscard]] int cell_of(const Vec3& p, std::size_t axis) const {
    return static_cast<int>((p[axis] - low_[axis]) / side_);
  }
  Vec3 low_;
  double side_ = 1;
  std::array<int, 3> count_{};
  std::vector<std::vector<std::uint32_t>> facets_;
};

/// Calls `act` for each pair of facets that cross.
template <typename Act>
void visit_crossings(const TriangleMesh& mesh, const Act& act) {
  if (mesh.facets.empty()) return;
  std::vector<Aabb> boxes;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) boxes.push_back(box_of(mesh, f));
  Cells cells(mesh, boxes);
  std::vector<std::uint32_t> near;
  for (std::uint32_t f = 0; f < mesh.facets.size(); ++f) {
    near.clear();
    cells.visit(boxes[f], [&](const std::vector<std::uint32_t>& cell) {
      for (const std::uint32_t other : cell) {
        if (other > f && overlap(boxes[f], boxes[other])) near.push_back(other);
      }
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t other : near) {
      if (facets_cross(mesh, mesh.facets[f], mesh.facets[other])) act(f, other);
    }
  }
}

}  // namespace

std::size_t count_self_intersections(const TriangleMesh& mesh) {
  std::size_t count = 0;
  visit_crossings(mesh, [&](std::uint32_t, std::uint32_t) { ++count; });
  return count;
}

std::vector<std::uint32_t> crossing_facets(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> facets;
  visit_crossings(mesh, [&](std::uint32_t a, std::uint32_t b) {
    facets.push_back(a);
    facets.push_back(b);
  });
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return facets;
}

}  // namespace carpus::mesh
