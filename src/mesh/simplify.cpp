// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/simplify.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.hpp"

namespace carpus::mesh {
namespace {

/// Attempts until the input is returned; each asks for twice the facets and half the error.
constexpr int kMaxAttempts = 4;

/// Positions about the first vertex as meshoptimizer takes them: floats keep 1e-6 mm over a hand.
std::vector<float> float_positions(const TriangleMesh& mesh) {
  std::vector<float> positions;
  positions.reserve(mesh.vertices.size() * 3);
  for (const Vec3& v : mesh.vertices) {
    const Vec3 local = v - mesh.vertices.front();
    for (const double c : {local.x, local.y, local.z}) positions.push_back(static_cast<float>(c));
  }
  return positions;
}

/// The facets with only the vertices that they use.
TriangleMesh compacted(const std::vector<Vec3>& vertices,
                       const std::vector<std::uint32_t>& indices) {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renamed(vertices.size(), kUnused);
  for (const std::uint32_t v : indices) renamed[v] = 0;
  TriangleMesh mesh;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (renamed[v] == kUnused) continue;
    renamed[v] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(vertices[v]);
  }
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    mesh.facets.push_back({renamed[indices[i]], renamed[indices[i + 1]], renamed[indices[i + 2]]});
  }
  return mesh;
}

}  // namespace

SimplifyResult simplify(const TriangleMesh& mesh, const SimplifyOptions& options) {
  if (!(options.max_error_mm > 0 && std::isfinite(options.max_error_mm))) {
    throw InvalidInput("simplify: max_error_mm must be positive and finite");
  }
  if (mesh.facets.size() <= options.target_facets) return {mesh, 0.0, 0};
  const std::vector<float> positions = float_positions(mesh);
  std::vector<std::uint32_t> indices;
  indices.reserve(mesh.facets.size() * 3);
  for (const Triangle& t : mesh.facets) indices.insert(indices.end(), t.begin(), t.end());

  constexpr std::size_t kStride = 3 * sizeof(float);
  const float extent = meshopt_simplifyScale(positions.data(), mesh.vertices.size(), kStride);
  std::size_t target = options.target_facets;
  double error_mm = options.max_error_mm;
  for (int attempt = 1; attempt <= kMaxAttempts && target < mesh.facets.size(); ++attempt) {
    std::vector<std::uint32_t> fewer(indices.size());
    float reached = 0;
    fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(), positions.data(),
                                  mesh.vertices.size(), kStride, target * 3,
                                  static_cast<float>(error_mm) / extent, 0, &reached));
    TriangleMesh simpler = compacted(mesh.vertices, fewer);
    if (check_surface(simpler) == SurfaceStatus::Ok) {
      return {std::move(simpler), static_cast<double>(reached * extent), attempt};
    }
    target = std::max<std::size_t>(2 * target, 4);
    error_mm /= 2;
  }
  return {mesh, 0.0, 0};
}

}  // namespace carpus::mesh
