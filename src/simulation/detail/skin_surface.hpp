// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The patient's own skin about the wrist, as scanned: its nearest place, which way is out, how deep
// a point lies under it. Made at set-up; queries allocate nothing and use only + - * / and sqrt.
#pragma once

#include <optional>
#include <vector>

#include "fields/triangle_tree.hpp"
#include "geometry/triangle_mesh.hpp"
#include "geometry/vec3.hpp"

namespace carpus::simulation::detail {

struct SkinPlace {
  Vec3 point;             ///< on the skin [mm]
  Vec3 normal{0, 0, 1};   ///< unit, out of the body; smooth over facets
  double depth_mm = 0.0;  ///< of what was asked for, under it; negative outside
};

class SkinSurface {
 public:
  /// @param skin  as scanned, outward; may be open at its rims.
  /// @param about, within_mm  what lies farther off is left out [mm].
  SkinSurface(const TriangleMesh& skin, const Vec3& about, double within_mm);

  [[nodiscard]] bool is_empty() const noexcept { return patch_.facets.empty(); }
  /// In the skin's frame; a place far off where there is no skin.
  [[nodiscard]] SkinPlace at(const Vec3& point) const noexcept;

 private:
  TriangleMesh patch_;
  std::vector<Vec3> normals_;  ///< by vertex, not of length 1
  std::optional<fields::TriangleTree> tree_;
};

}  // namespace carpus::simulation::detail
