// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Which ligament lines a place of a joint's wall, and where the place lies in that one's fibres.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::arthroscopy::detail {

/// By vertex of a wall.
struct LaidFibres {
  std::vector<const soft_tissue::Ligament*> ligament;  ///< that lines it; null: none
  /// Across and along a ligament's strands [mm], far apart for two ligaments; z: 1 well on one,
  /// less towards another, 0 on none. Also beside a ligament, so that its fibres run out under what
  /// lines the wall there.
  std::vector<Vec3> fibre;
};

/// @param wall  closed, as scanned @param lining  of its vertices
/// @return that points into `tissue`.
[[nodiscard]] LaidFibres lay_fibres(const TriangleMesh& wall,
                                    const std::vector<soft_tissue::Lining>& lining,
                                    const soft_tissue::SoftTissue& tissue);

}  // namespace carpus::arthroscopy::detail
