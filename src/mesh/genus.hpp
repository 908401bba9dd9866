// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How many handles a surface has: a bone has none, and one that was leaked through or pierced has.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// Of a closed surface of one piece: 1 - (V - E + F) / 2 with the vertices that are used.
/// @pre check_surface(mesh) is Ok
[[nodiscard]] int genus_of(const TriangleMesh& mesh);

}  // namespace carpus::mesh
