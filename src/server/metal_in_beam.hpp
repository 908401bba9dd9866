// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Steel and titanium in the beam: guide wire, screw and driver as they lay at a tick.
#pragma once

#include <vector>

#include "fluoroscopy/metal.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::server {

/// Guide wires for headless screws are 6 in long, near enough [mm].
inline constexpr double kGuideWireLengthMm = 150.0;
/// Shaft of the cannulated hexagonal driver [mm].
inline constexpr double kDriverDiameterMm = 2.5;

/// What of metal is in the picture, frame Patient.
[[nodiscard]] std::vector<fluoroscopy::MetalCylinder> metal_in_beam(
    const simulation::Snapshot& snapshot);

}  // namespace carpus::server
