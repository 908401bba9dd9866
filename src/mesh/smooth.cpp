// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/smooth.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "mesh/neighbours.hpp"

namespace carpus::mesh {
namespace {

/// v += factor * (mean of neighbours - v), from the old positions of all.
void step(std::vector<Vec3>& vertices,
          std::vector<Vec3>& moved,
          const Neighbours& neighbours,
          double factor) {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    moved[v] = vertices[v];
    const auto around = neighbours.of(v);
    if (around.empty()) continue;
    Vec3 sum{};
    for (const std::uint32_t other : around) sum += vertices[other];
    moved[v] += (sum / static_cast<double>(around.size()) - vertices[v]) * factor;
  }
  std::swap(vertices, moved);
}

void restore_volume(TriangleMesh& mesh, double volume_mm3) {
  const double now = volume_of(mesh);
  if (!(now * volume_mm3 > 0)) return;
  const double scale = std::cbrt(volume_mm3 / now);
  const Vec3 centre = centroid_of(mesh);
  for (Vec3& v : mesh.vertices) v = centre + (v - centre) * scale;
}

}  // namespace

TriangleMesh smooth(TriangleMesh mesh, const SmoothOptions& options) {
  if (!(options.iterations >= 0 && options.lambda > 0 && options.lambda < 1 &&
        options.mu < -options.lambda && options.mu > -1)) {
    throw InvalidInput("smooth: iterations >= 0 and 0 < lambda < -mu < 1 are required");
  }
  const Neighbours neighbours(mesh);
  const double volume_mm3 = options.restores_volume ? volume_of(mesh) : 0.0;
  const std::vector<Vec3> before =
      options.max_displacement_mm > 0 ? mesh.vertices : std::vector<Vec3>{};
  std::vector<Vec3> moved(mesh.vertices.size());
  for (int i = 0; i < options.iterations; ++i) {
    step(mesh.vertices, moved, neighbours, options.lambda);
    step(mesh.vertices, moved, neighbours, options.mu);
  }
  if (options.restores_volume) restore_volume(mesh, volume_mm3);
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Vec3 moved_by = mesh.vertices[v] - before[v];
    const double way = length(moved_by);
    if (way > options.max_displacement_mm) {
      mesh.vertices[v] = before[v] + moved_by * (options.max_displacement_mm / way);
    }
  }
  return mesh;
}

}  // namespace carpus::mesh
