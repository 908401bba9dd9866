// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Size, place and proportions of the parametric wrist's bones, with the hand held in many ways.
#pragma once

#include <array>
#include <vector>

#include "anatomy/bone_id.hpp"
#include "anatomy/region_shape.hpp"
#include "anatomy/wrist_model.hpp"

namespace carpus::anatomy {

/// Shapes in the order of kAllBones, frame Wrist of the model's side [mm].
using ModelShapes = std::array<BodyShape, kBoneCount>;

/// Measures the model on a lattice of 0.7 mm. The shafts that the model cuts count as cut.
[[nodiscard]] ModelShapes measure_model(const WristModel& model);

/// The same for the generic wrist of one side, measured once.
[[nodiscard]] const ModelShapes& generic_model_shapes(Side side);

/// Where the bones' centroids are when the hand is held in one way; forearm at rest.
using BonePlaces = std::array<Vec3, kBoneCount>;

/// Eighteen postures from 70 degrees of extension to 30 of flexion and 15 degrees of ulnar to 25 of
/// radial deviation. Half of each rotation happens between forearm and carpus, half between the two
/// carpal rows, as in life to a first approximation [ruby1988relative].
[[nodiscard]] std::vector<BonePlaces> places_in_postures(const ModelShapes& shapes, Side side);

}  // namespace carpus::anatomy
