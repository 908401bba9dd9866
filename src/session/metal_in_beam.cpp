// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/metal_in_beam.hpp"

#include <optional>

#include "instruments/instrument.hpp"

namespace carpus::session {

namespace {

/// Nothing where the beam hardly sees it.
std::optional<double> attenuation_of(instruments::Material material) noexcept {
  switch (material) {
    case instruments::Material::Steel:
      return fluoroscopy::kSteelPerMm;
    case instruments::Material::Titanium:
      return fluoroscopy::kTitaniumPerMm;
    case instruments::Material::Handle:
    case instruments::Material::Black:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::vector<fluoroscopy::MetalCylinder> metal_in_beam(const simulation::Snapshot& snapshot) {
  std::vector<fluoroscopy::MetalCylinder> metal;
  const auto all = instruments::catalogue();
  for (const simulation::ItemView& item : snapshot.items) {
    if (item.instrument >= all.size()) continue;
    const bool is_held = item.hand != simulation::kNoHand;
    for (const instruments::BeamRod& rod : all[item.instrument].rods) {
      const std::optional<double> attenuation = attenuation_of(rod.material);
      if (!attenuation || (rod.only_in_hand && !is_held)) continue;
      metal.push_back({item.tip_in_patient + item.shaft_in_patient * rod.from_mm,
                       item.tip_in_patient + item.shaft_in_patient * rod.to_mm, rod.radius_mm,
                       rod.end_radius_mm, rod.bore_radius_mm, rod.thread_depth_mm,
                       rod.thread_pitch_mm, *attenuation});
    }
  }
  return metal;
}

}  // namespace carpus::session
