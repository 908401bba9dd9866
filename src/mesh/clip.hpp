// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Cutting a surface at a plane.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// The part of `mesh` on the side of a plane towards which `normal` points. Facets that the plane
/// crosses are cut, neighbours at the same points, so that the edge is straight; the surface is
/// left open there. Vertices that nothing uses are dropped; their order is kept.
/// @param normal  need not be unit.
[[nodiscard]] TriangleMesh clipped(const TriangleMesh& mesh, const Vec3& point, const Vec3& normal);

}  // namespace carpus::mesh
