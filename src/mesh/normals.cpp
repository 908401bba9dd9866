// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/normals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/trilinear.hpp"

namespace carpus::mesh {
namespace {

/// Difference quotient [value/mm] along a grid axis at voxel coordinates within the grid, one-sided
/// at the border.
template <typename T>
double slope_along(const GridView<const T>& values,
                   const Vec3& voxel,
                   std::size_t axis,
                   double reach_mm) {
  const double last = values.geometry().size[axis] - 1;
  const double reach = reach_mm > 0 ? reach_mm / values.geometry().spacing[axis] : 0.5;
  Vec3 before = voxel;
  Vec3 after = voxel;
  before[axis] = std::max(0.0, voxel[axis] - reach);
  after[axis] = std::min(last, voxel[axis] + reach);
  const double step = (after[axis] - before[axis]) * values.geometry().spacing[axis];
  if (!(step > 0)) return 0;
  return (sample_trilinear(values, after, 0) - sample_trilinear(values, before, 0)) / step;
}

}  // namespace

template <typename T>
std::vector<Vec3> gradient_normals(const GridView<const T>& values,
                                   std::span<const Vec3> points_in_patient,
                                   double reach_mm) {
  const GridGeometry& grid = values.geometry();
  std::vector<Vec3> normals;
  normals.reserve(points_in_patient.size());
  for (const Vec3& p : points_in_patient) {
    Vec3 voxel = grid.voxel_from_patient(p);
    bool near_grid = true;  // surfaces closed at the border lie half a voxel outside
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double last = grid.size[axis] - 1;
      near_grid = near_grid && voxel[axis] >= -1 && voxel[axis] <= last + 1;
      voxel[axis] = std::clamp(voxel[axis], 0.0, last);
    }
    if (!near_grid) {
      normals.push_back({});
      continue;
    }
    const Vec3 slope{slope_along(values, voxel, 0, reach_mm),
                     slope_along(values, voxel, 1, reach_mm),
                     slope_along(values, voxel, 2, reach_mm)};
    normals.push_back(normalized_or(-(grid.direction * slope), {}));
  }
  return normals;
}

template std::vector<Vec3> gradient_normals(const GridView<const float>&,
                                            std::span<const Vec3>,
                                            double);
template std::vector<Vec3> gradient_normals(const GridView<const std::int16_t>&,
                                            std::span<const Vec3>,
                                            double);

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (const Triangle& t : mesh.facets) {
    const std::array<Vec3, 3> p{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const Vec3 normal = normalized_or(cross(p[1] - p[0], p[2] - p[0]), {});
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = p[(i + 1) % 3] - p[i];
      const Vec3 b = p[(i + 2) % 3] - p[i];
      normals[t[i]] += normal * std::atan2(length(cross(a, b)), dot(a, b));
    }
  }
  for (Vec3& n : normals) n = normalized_or(n, {});
  return normals;
}

}  // namespace carpus::mesh
