// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A screw of the catalogue as it lies in a scaphoid.
#pragma once

#include <vector>

#include "fluoroscopy/metal.hpp"
#include "geometry/pose.hpp"
#include "instruments/instrument.hpp"

namespace carpus::view_trainer {

/// Frame Bone of the scaphoid.
struct PlacedScrew {
  instruments::InstrumentIndex screw = instruments::kNoInstrument;
  Vec3 tip;    ///< middle of its foremost face [mm]
  Vec3 shaft;  ///< unit vector from the tip to the tail

  [[nodiscard]] const instruments::Instrument& instrument() const {
    return instruments::catalogue()[screw];
  }
  [[nodiscard]] Vec3 tail() const { return tip + shaft * instrument().length_mm; }
};

/// What of it is in the beam, frame Patient; nothing of what drives it.
[[nodiscard]] std::vector<fluoroscopy::MetalCylinder> metal_of(
    const PlacedScrew& placed,
    const Pose<frame::Patient, frame::Bone>& patient_from_bone);

}  // namespace carpus::view_trainer
