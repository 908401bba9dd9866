// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Takes the steps of the voxels off a surface without shrinking it.
#pragma once

#include "geometry/triangle_mesh.hpp"

namespace carpus::mesh {

/// Taubin's filter [taubin1995signal]: a shrinking step of `lambda`, then a growing step of `mu`.
/// The defaults pass wavelengths beyond about ten edges (pass band 1/lambda + 1/mu = 0.1).
struct SmoothOptions {
  int iterations = 10;  ///< pairs of steps
  double lambda = 0.5;  ///< in (0, 1)
  double mu = -0.526;   ///< below -lambda
  /// Scales the result about its centroid to the volume of the input, closed surfaces only:
  /// Taubin's filter keeps volume only to about 1 % on bones of few voxels.
  bool restores_volume = true;
  /// No vertex ends farther from where it was [mm]; 0 for no bound. The bound holds last, so that
  /// the volume is then only nearly restored.
  double max_displacement_mm = 0;
};

/// The mesh with smoothed vertices [same unit and frame]; facets are unchanged, hence a manifold
/// stays one. A vertex moves towards or away from the mean of its neighbours.
/// @throws InvalidInput if an option is out of range.
[[nodiscard]] TriangleMesh smooth(TriangleMesh mesh, const SmoothOptions& options = {});

}  // namespace carpus::mesh
