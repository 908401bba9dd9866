// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/volumes/axis_box.hpp"

#include "geometry/aabb.hpp"

namespace carpus::survey {

AxisBox AxisBox::around(std::span<const TrianglePoints> triangles) {
  Aabb box;
  for (const TrianglePoints& t : triangles) {
    for (const Vec3& v : t) box.include(v);
  }
  return {box.centre(), box.extent() * 0.5};
}

}  // namespace carpus::survey
