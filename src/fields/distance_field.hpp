// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Signed distance to a bone's real surface on a regular grid: contact with concavities, which hulls
// hide, at a bounded cost per query.
#pragma once

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::fields {

struct DistanceFieldOptions {
  double spacing_mm = 0.4;
  double band_mm = 4.0;  ///< distances are clamped to +-band_mm; the grid reaches this far outside
};

/// Largest grid that is built; 2^28 floats are 1 GiB.
inline constexpr std::size_t kMaxFieldVoxels = std::size_t{1} << 28U;

/// Distance from each voxel centre to the surface [mm], negative inside; exact (to float rounding)
/// within the band, +-band_mm beyond it.
///
/// @param mesh  closed, oriented 2-manifold, outward [mm].
/// @return a grid with axes along those of the mesh's frame.
/// @throws InvalidInput if the mesh is not closed, an option is not positive, or the grid would
///     exceed kMaxFieldVoxels.
/// Cost: O(voxels in band * log facets); runs through parallel_for, the same bytes for any number
/// of threads.
[[nodiscard]] Grid<float> build_distance_field(const TriangleMesh& mesh,
                                               const DistanceFieldOptions& options = {});

/// What the field says at a point. Between voxels it is off the (clamped) distance by at most
/// sqrt(3) / 2 of the spacing; contact_field.hpp proves that and a second, tighter bound.
struct DistanceSample {
  double distance_mm = 0.0;  ///< signed; trilinear between voxels
  Vec3 gradient;  ///< of that interpolation [mm/mm], outwards; about a unit vector within
                  ///< the band, zero where the field is clamped. Not normalised.
  bool is_inside_grid = false;
};

/// Samples the field at a point in its frame. Outside the grid (or for a NaN) the answer is
/// `is_inside_grid` false, the field's value at the nearest border voxel, and no gradient.
/// Real-time: no allocation, bounded, only + - * /. The field must not be empty.
[[nodiscard]] DistanceSample sample_distance(const Grid<float>& field, const Vec3& point) noexcept;

}  // namespace carpus::fields
