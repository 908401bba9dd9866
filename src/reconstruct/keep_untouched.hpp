// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A new version of a case changes what a person changed, and no other bone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cases/case_data.hpp"
#include "geometry/grid.hpp"
#include "geometry/triangle_mesh.hpp"
#include "reconstruct/bone_trust.hpp"

namespace carpus::reconstruct {

struct EarlierBone {
  std::uint8_t label = 0;
  TriangleMesh surface;                 ///< [Patient, mm]
  std::optional<BoneTrust> trust = {};  ///< what was said of it; cases of older programs have none
};

/// What of the version before a new one may take over.
struct EarlierVersion {
  Grid<std::uint8_t> labels;
  std::vector<EarlierBone> bones;
};

/// Bones whose voxels are the same in `given` as in the earlier version get the surface and the
/// voxels that they had there; of the others what `data` has stays, but for voxels of the former.
/// @param given  labels as a person left them, on the grid of both
/// @param data  bones with labels and surfaces, and labels
/// @return by label: which have the surface of the earlier version
std::array<bool, 256> keep_untouched(const EarlierVersion& earlier,
                                     const Grid<std::uint8_t>& given,
                                     cases::CaseData& data);

/// By label: whether neither the bone nor anything within 1.5 mm of it was changed, which is as far
/// as its measures look. What was said of such a bone is still so: measured again, on labels that
/// are given and not segmented, a doubt would go by itself although nobody looked at the bone.
[[nodiscard]] std::array<bool, 256> left_alone(const Grid<std::uint8_t>& before,
                                               const Grid<std::uint8_t>& given);

}  // namespace carpus::reconstruct
