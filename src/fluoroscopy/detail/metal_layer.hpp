// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Metal over a picture of tissue.
#pragma once

#include <span>

#include "fluoroscopy/c_arm.hpp"
#include "fluoroscopy/detector.hpp"
#include "fluoroscopy/metal.hpp"

namespace carpus::fluoroscopy::detail {

/// Adds metal to every value that the collimator does not cover, and fills `map.metal`.
void add_metal(AttenuationMap& map, const CArmPose& pose, std::span<const MetalCylinder> metal);

}  // namespace carpus::fluoroscopy::detail
