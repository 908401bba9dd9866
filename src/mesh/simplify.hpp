// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Fewer triangles within a stated error, without leaving the closed manifolds.
#pragma once

#include <cstddef>

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

struct SimplifyOptions {
  std::size_t target_facets = 0;  ///< stop at this many; the error may stop it earlier
  double max_error_mm = 0.1;  ///< of the quadric metric: about the distance a surface point moves
};

/// What simplify made.
struct SimplifyResult {
  TriangleMesh mesh;      ///< its vertices are some of the input's, in the input's order
  double error_mm = 0.0;  ///< reached, as above; 0 when nothing was removed
  int attempts = 0;       ///< 1, or more where the first results were not manifold; 0: input kept
};

/// Edge collapses by quadric error [garland1997surface] with meshoptimizer, checked afterwards: if
/// the input is a closed, oriented 2-manifold the result is one too, since a result that is not is
/// thrown away and a finer one tried, down to the input itself.
/// @throws InvalidInput if max_error_mm is not positive and finite.
[[nodiscard]] SimplifyResult simplify(const TriangleMesh& mesh, const SimplifyOptions& options);

}  // namespace carpus::mesh
