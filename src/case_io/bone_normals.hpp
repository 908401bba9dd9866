// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a surface that was found in a CT is shaded, a bone's or the skin: by the CT's own slope,
// which knows what the facets have smoothed away.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/pose.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::case_io {

/// Unit outward normals of the vertices, in the surface's frame: against the CT's gradient
/// (thesis §3.3), where that points nearly as the facets do; elsewhere, as in a joint's gap,
/// between fragments or at the end of the scan, those of the facets.
[[nodiscard]] std::vector<Vec3> bone_normals(
    const TriangleMesh& surface,
    const Pose<frame::Patient, frame::Bone>& patient_from_bone,
    const GridView<const std::int16_t>& ct);

}  // namespace carpus::case_io
