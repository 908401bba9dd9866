// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Moves bones' surfaces onto the edge that the CT shows, by less than a voxel. The field that
// surfaces are cut from knows the cortex by the highest voxel near by; here the CT is read across
// the surface itself, averaged along it, and so the cortex beside each place is known with little
// noise.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::reconstruct {

struct SharpenOptions {
  /// Of the way from soft tissue to the cortex, where a thick cortex has its edge. Of a thinner one
  /// the blur leaves less than its own density, and half of that lies outside the bone: its edge is
  /// put at half of what the scan's thick cortex reaches, but not above `thin_edge` of what is left
  /// (as imaging::measure_edge_excess does).
  double thick_edge = 0.5;
  double thin_edge = 0.66;
  double farthest_mm = 0.35;  ///< no vertex is moved farther: about a voxel
};

/// Moves the vertices of `surfaces` [Patient, mm] along their normals. All bones of a scan at once:
/// which cortex is thick is asked of all. Bones that move towards each other meet
/// nowhere. Vertices stay where the surface would cross itself, and
/// beside the scan's faces.
///
/// @param soft_tissue_hu  median density around the bones
void sharpen_surfaces(std::span<TriangleMesh* const> surfaces,
                      const GridView<const std::int16_t>& ct,
                      double soft_tissue_hu,
                      const SharpenOptions& options = {});

}  // namespace carpus::reconstruct
