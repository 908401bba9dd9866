// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A hull from its stored triangles: neighbours, planes and where its corners came from.
#pragma once

#include <optional>
#include <span>

#include "geometry/convex_polytope.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::case_io {

/// Rebuilds what is not stored. Empty where `mesh` is no closed convex surface, or a vertex is none
/// of `points`. Planes: unit normal of the facet, offset so that no vertex lies outside.
[[nodiscard]] std::optional<ConvexPolytope> hull_from_mesh(const TriangleMesh& mesh,
                                                           std::span<const Vec3> points);

}  // namespace carpus::case_io
