// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A new version of a case changes what a person changed, and no other bone.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/case_data.hpp"
#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::reconstruct {

struct EarlierSurface {
  std::uint8_t label = 0;
  TriangleMesh surface;  ///< [Patient, mm]
};

/// What of the version before a new one may take over.
struct EarlierVersion {
  Grid<std::uint8_t> labels;
  std::vector<EarlierSurface> surfaces;
};

/// Bones whose voxels are the same in `given` as in the earlier version get the surface and the
/// voxels that they had there; of the others what `data` has stays, but for voxels of the former.
/// @param given  labels as a person left them, on the grid of both
/// @param data  bones with labels and surfaces, and labels
void keep_untouched(const EarlierVersion& earlier,
                    const Grid<std::uint8_t>& given,
                    cases::CaseData& data);

}  // namespace carpus::reconstruct
