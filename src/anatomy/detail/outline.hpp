// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Outlines of a closed surface in a plane, exactly: each facet that the plane crosses gives a
// segment, segments that share an edge of the surface make an outline, and Green's theorem its area
// and centroid.
#pragma once

#include "anatomy/bone_solid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::detail {

/// The outline that holds `point`, or the one nearest to it; its area is 0 where the plane misses.
/// @param normal  unit.
[[nodiscard]] BoneSection outline_around(const TriangleMesh& mesh,
                                         const Vec3& point,
                                         const Vec3& normal);

}  // namespace carpus::detail
