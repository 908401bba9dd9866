// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wall of one joint's space as scanned: what lines it, which bone is nearest, what of it lies
// nearest to a place.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cases/case_data.hpp"
#include "fields/triangle_tree.hpp"
#include "geometry/vec3.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::arthroscopy::detail {

struct SpaceWalls {
  /// Keeps a pointer to `of`, whose surface is not empty.
  SpaceWalls(const soft_tissue::Space& of, const cases::CaseData& data);

  const soft_tissue::Space* space;
  fields::TriangleTree tree;
  std::vector<std::uint8_t> nearest;  ///< body, by vertex
};

/// The vertex of the joint's wall nearest to a point: of this lining, and beside this body, where
/// they are asked for.
[[nodiscard]] std::optional<Vec3> on_wall(const SpaceWalls& walls,
                                          const Vec3& point,
                                          std::optional<soft_tissue::Lining> lining,
                                          std::optional<std::uint8_t> body = std::nullopt);

/// Whether a vertex of the wall is the disc's.
[[nodiscard]] bool lies_on_disc(const SpaceWalls& walls, const Vec3& at);

}  // namespace carpus::arthroscopy::detail
