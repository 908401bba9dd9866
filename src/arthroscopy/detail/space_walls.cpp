// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// By all vertices: a wall has few enough, and a map is made once a case.
#include "arthroscopy/detail/space_walls.hpp"

#include <cstddef>

#include "arthroscopy/detail/scanned_bones.hpp"

namespace carpus::arthroscopy::detail {

using soft_tissue::Lining;

SpaceWalls::SpaceWalls(const soft_tissue::Space& of, const cases::CaseData& data)
    : space(&of), tree(of.surface) {
  for (const Vec3& v : of.surface.vertices) nearest.push_back(nearest_body(data, v));
}

std::optional<Vec3> on_wall(const SpaceWalls& walls,
                            const Vec3& point,
                            std::optional<Lining> lining,
                            std::optional<std::uint8_t> body) {
  const std::vector<Vec3>& vertices = walls.space->surface.vertices;
  std::optional<Vec3> best;
  double least = 1e18;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (lining && walls.space->lining[i] != *lining) continue;
    const double far = squared_length(vertices[i] - point);
    if (far < least && (!body || walls.nearest[i] == *body)) {
      least = far;
      best = vertices[i];
    }
  }
  return best;
}

bool lies_on_disc(const SpaceWalls& walls, const Vec3& at) {
  const std::vector<Vec3>& vertices = walls.space->surface.vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i] == at) return walls.space->lining[i] == Lining::Disc;
  }
  return false;
}

}  // namespace carpus::arthroscopy::detail
