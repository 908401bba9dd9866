// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Steel and titanium in the beam, as the instruments' data describe them, where they lay at a tick.
#pragma once

#include <vector>

#include "fluoroscopy/metal.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::session {

/// What of metal is in the picture, frame Patient.
[[nodiscard]] std::vector<fluoroscopy::MetalCylinder> metal_in_beam(
    const simulation::Snapshot& snapshot);

}  // namespace carpus::session
