// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Sweeps the grid slice by slice. Every grid edge that the surface crosses gets one vertex, kept in
// a cache of two slices until the cubes on both sides of the slab have used it.
#include "mesh/marching_cubes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/check.hpp"
#include "core/error.hpp"
#include "mesh/cube_table.hpp"

namespace carpus::mesh {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// Vertices on the edges that start in one slice: along x, y, and z (towards the next slice).
struct SliceVertices {
  std::array<std::vector<std::uint32_t>, 3> along;
  std::vector<std::uint8_t> inside;
};

class Sweep {
 public:
  Sweep(const GridView<const float>& values, double iso, bool close_at_border)
      : values_(values),
        iso_(iso),
        first_(close_at_border ? -1 : 0),
        nx_(values.geometry().size[0] - 2 * first_),
        ny_(values.geometry().size[1] - 2 * first_),
        nz_(values.geometry().size[2] - 2 * first_),
        flips_(values.geometry().direction.determinant() < 0) {}

  TriangleMesh run() {
    const std::size_t area = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
    for (SliceVertices* slice : {&low_, &high_}) {
      for (auto& along : slice->along) along.assign(area, kNoVertex);
      slice->inside.assign(area, 0);
    }
    classify(0, low_);
    make_edges_in_slice(0, low_);
    for (int k = 0; k + 1 < nz_; ++k) {
      classify(k + 1, high_);
      make_edges_in_slice(k + 1, high_);
      make_edges_between(k);
      make_triangles();
      std::swap(low_, high_);
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(i);
  }
  [[nodiscard]] VoxelIndex voxel(int i, int j, int k) const {
    return {i + first_, j + first_, k + first_};
  }

  void classify(int k, SliceVertices& slice) const {
    for (int j = 0; j < ny_; ++j) {
      for (int i = 0; i < nx_; ++i) {
        const VoxelIndex v = voxel(i, j, k);
        slice.inside[at(i, j)] =
            values_.geometry().contains(v) && static_cast<double>(values_[v]) >= iso_ ? 1 : 0;
      }
    }
  }

  /// Where the surface crosses the edge from `a` to `b`, one of which is inside.
  [[nodiscard]] double crossing(const VoxelIndex& a, const VoxelIndex& b) const {
    if (!values_.geometry().contains(a) || !values_.geometry().contains(b)) return 0.5;
    const auto at_a = static_cast<double>(values_[a]);
    const double t = (iso_ - at_a) / (static_cast<double>(values_[b]) - at_a);
    if (!(t >= 0 && t <= 1)) return 0.5;  // an infinite or NaN neighbour
    return std::clamp(t, kLeastEdgeFraction, 1 - kLeastEdgeFraction);
  }

  std::uint32_t add_vertex(const Vec3& voxel_coordinates) {
    CARPUS_CHECK(mesh_.vertices.size() < kNoVertex);
    mesh_.vertices.push_back(values_.geometry().patient_from_voxel(voxel_coordinates));
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  std::uint32_t add_crossing(const VoxelIndex& a, std::size_t axis) {
    const VoxelIndex b{a.x + (axis == 0), a.y + (axis == 1), a.z + (axis == 2)};
    Vec3 p{static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
    p[axis] += crossing(a, b);
    return add_vertex(p);
  }

  void make_edges_in_slice(int k, SliceVertices& slice) {
    for (int j = 0; j < ny_; ++j) {
      for (int i = 0; i < nx_; ++i) {
        const std::uint8_t here = slice.inside[at(i, j)];
        if (i + 1 < nx_ && slice.inside[at(i + 1, j)] != here) {
          slice.along[0][at(i, j)] = add_crossing(voxel(i, j, k), 0);
        }
        if (j + 1 < ny_ && slice.inside[at(i, j + 1)] != here) {
          slice.along[1][at(i, j)] = add_crossing(voxel(i, j, k), 1);
        }
      }
    }
  }

  void make_edges_between(int k) {
    for (int j = 0; j < ny_; ++j) {
      for (int i = 0; i < nx_; ++i) {
        if (low_.inside[at(i, j)] != high_.inside[at(i, j)]) {
          low_.along[2][at(i, j)] = add_crossing(voxel(i, j, k), 2);
        }
      }
    }
  }

  [[nodiscard]] std::uint32_t edge_vertex(int i, int j, std::uint8_t edge) const {
    const CubeEdge& e = kCubeEdges[edge];
    const SliceVertices& slice = (e.low_corner & 4U) != 0 ? high_ : low_;
    return slice.along[e.axis][at(i + (e.low_corner & 1), j + (e.low_corner >> 1 & 1))];
  }

  void make_triangles() {
    for (int j = 0; j + 1 < ny_; ++j) {
      for (int i = 0; i + 1 < nx_; ++i) {
        const auto corners = [&](const SliceVertices& s) {
          return static_cast<unsigned>(s.inside[at(i, j)] | s.inside[at(i + 1, j)] << 1 |
                                       s.inside[at(i, j + 1)] << 2 |
                                       s.inside[at(i + 1, j + 1)] << 3);
        };
        const unsigned configuration = corners(low_) | corners(high_) << 4U;
        if (configuration != 0 && configuration != 255) emit(i, j, cube_table()[configuration]);
      }
    }
  }

  void emit(int i, int j, const CubeCase& cube) {
    std::array<std::uint32_t, 4> centres{};
    for (std::size_t c = 0; c < cube.centred_loops.size(); ++c) {
      Vec3 sum{};
      for (const std::uint8_t e : cube.centred_loops[c])
        sum += mesh_.vertices[edge_vertex(i, j, e)];
      mesh_.vertices.push_back(sum / static_cast<double>(cube.centred_loops[c].size()));
      centres[c] = static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }
    const auto vertex = [&](std::uint8_t name) {
      return name >= kFirstLoopCentre ? centres[static_cast<std::size_t>(name - kFirstLoopCentre)]
                                      : edge_vertex(i, j, name);
    };
    for (const auto& t : cube.triangles) {
      const Triangle facet{vertex(t[0]), vertex(t[1]), vertex(t[2])};
      mesh_.facets.push_back(flips_ ? Triangle{facet[0], facet[2], facet[1]} : facet);
    }
  }

  const GridView<const float>& values_;
  double iso_;
  int first_;  ///< voxel coordinate of the first sample: -1 with a border of outside
  int nx_;
  int ny_;
  int nz_;
  bool flips_;  ///< a left-handed grid turns triangles over
  SliceVertices low_;
  SliceVertices high_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh extract_isosurface(const GridView<const float>& values,
                                double iso,
                                const MarchingCubesOptions& options) {
  if (!std::isfinite(iso)) throw InvalidInput("marching cubes: the iso value is not finite");
  if (values.geometry().voxel_count() == 0) {
    throw InvalidInput("marching cubes: the grid has no voxels");
  }
  return Sweep(values, iso, options.close_at_border).run();
}

}  // namespace carpus::mesh
