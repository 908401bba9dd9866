// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/metal_in_beam.hpp"

#include <algorithm>
#include <optional>
#include <vector>

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
    case instruments::Material::Glove:
      break;
  }
  return std::nullopt;
}

/// The rod between two places along its instrument; nothing where none of it lies there.
std::optional<instruments::BeamRod> part_of(const instruments::BeamRod& rod,
                                            double from_mm,
                                            double to_mm) noexcept {
  instruments::BeamRod part = rod;
  part.from_mm = std::max(rod.from_mm, from_mm);
  part.to_mm = std::min(rod.to_mm, to_mm);
  const double length = rod.to_mm - rod.from_mm;
  if (!(part.to_mm > part.from_mm) || !(length > 0.0)) return std::nullopt;
  const auto radius_at = [&](double at_mm) {
    return rod.radius_mm + (rod.end_radius_mm - rod.radius_mm) * ((at_mm - rod.from_mm) / length);
  };
  part.radius_mm = radius_at(part.from_mm);
  part.end_radius_mm = radius_at(part.to_mm);
  return part;
}

class MetalOf {
 public:
  MetalOf(const simulation::ItemView& item, std::vector<fluoroscopy::MetalCylinder>& metal)
      : item_(item), metal_(metal) {}

  /// What is bent stands off behind the bend; what broke off is gone.
  void add(const instruments::BeamRod& rod) {
    const std::optional<double> attenuation = attenuation_of(rod.material);
    if (!attenuation || (rod.only_in_hand && item_.hand == simulation::kNoHand)) return;
    if (rod.only_in_hand || item_.body == simulation::kNoBody) {
      return put(rod, item_.shaft_in_patient, 0.0, *attenuation);
    }
    const double bend = std::min(item_.bent_at_mm, item_.length_mm);
    if (const auto inner = part_of(rod, 0.0, bend)) {
      put(*inner, item_.shaft_in_patient, 0.0, *attenuation);
    }
    if (const auto outer = part_of(rod, bend, item_.length_mm)) {
      put(*outer, item_.outer_shaft_in_patient, bend, *attenuation);
    }
  }

 private:
  /// @param along  direction of the part, straight on from `from_mm` behind the tip.
  void put(const instruments::BeamRod& rod, const Vec3& along, double from_mm, double attenuation) {
    const Vec3 origin = item_.tip_in_patient + item_.shaft_in_patient * from_mm - along * from_mm;
    metal_.push_back({origin + along * rod.from_mm, origin + along * rod.to_mm, rod.radius_mm,
                      rod.end_radius_mm, rod.bore_radius_mm, rod.thread_depth_mm,
                      rod.thread_pitch_mm, attenuation});
  }

  const simulation::ItemView& item_;
  std::vector<fluoroscopy::MetalCylinder>& metal_;
};

}  // namespace

std::vector<fluoroscopy::MetalCylinder> metal_in_beam(const simulation::Snapshot& snapshot) {
  std::vector<fluoroscopy::MetalCylinder> metal;
  const auto all = instruments::catalogue();
  for (const simulation::ItemView& item : snapshot.items) {
    if (item.instrument >= all.size()) continue;
    MetalOf of_item(item, metal);
    for (const instruments::BeamRod& rod : all[item.instrument].rods) of_item.add(rod);
  }
  return metal;
}

}  // namespace carpus::session
