// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/placed_screw.hpp"

namespace carpus::view_trainer {

std::vector<fluoroscopy::MetalCylinder> metal_of(
    const PlacedScrew& placed,
    const Pose<frame::Patient, frame::Bone>& patient_from_bone) {
  const auto at = [&](double z) {
    return (patient_from_bone * Point<frame::Bone>{placed.tip + placed.shaft * z}).v;
  };
  std::vector<fluoroscopy::MetalCylinder> metal;
  for (const instruments::BeamRod& rod : placed.instrument().rods) {
    if (rod.only_in_hand) continue;
    metal.push_back({at(rod.from_mm), at(rod.to_mm), rod.radius_mm, rod.end_radius_mm,
                     rod.bore_radius_mm, rod.thread_depth_mm, rod.thread_pitch_mm,
                     rod.material == instruments::Material::Titanium ? fluoroscopy::kTitaniumPerMm
                                                                     : fluoroscopy::kSteelPerMm});
  }
  return metal;
}

}  // namespace carpus::view_trainer
