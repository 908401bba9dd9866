// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/metal_in_beam.hpp"

#include "procedure/screw_catalogue.hpp"

namespace carpus::server {

namespace {

using fluoroscopy::MetalCylinder;

void add_screw(const simulation::Snapshot& snapshot, std::vector<MetalCylinder>& metal) {
  const auto screws = procedure::screw_catalogue();
  const auto index = static_cast<std::size_t>(snapshot.screw.index);
  if (snapshot.screw.index < 0 || index >= screws.size() || !snapshot.wire.engaged) return;
  const procedure::Screw& screw = screws[index];
  const Vec3 entry = snapshot.wire.entry_in_patient;
  const Vec3 inwards = snapshot.wire.direction_in_patient;
  const Vec3 tip = entry + inwards * snapshot.screw.advance_mm;
  const Vec3 tail = tip - inwards * screw.length_mm;
  metal.push_back(fluoroscopy::make_headless_screw(
      tail, tip, screw.tail_diameter_mm, screw.tip_diameter_mm, procedure::kWireDiameterMm));
  if (snapshot.instrument != simulation::Instrument::ScrewDriver) return;
  MetalCylinder driver =
      fluoroscopy::make_wire(tail, tail - inwards * kGuideWireLengthMm, kDriverDiameterMm);
  driver.bore_radius_mm = procedure::kWireDiameterMm / 2;
  metal.push_back(driver);
}

}  // namespace

std::vector<MetalCylinder> metal_in_beam(const simulation::Snapshot& snapshot) {
  std::vector<MetalCylinder> metal;
  if (snapshot.instrument == simulation::Instrument::None) {
    add_screw(snapshot, metal);
    return metal;
  }
  if (snapshot.wire.engaged) {
    const Vec3 tip = snapshot.wire.tip_in_patient;
    metal.push_back(
        fluoroscopy::make_wire(tip, tip - snapshot.wire.direction_in_patient * kGuideWireLengthMm,
                               procedure::kWireDiameterMm));
  } else if (snapshot.instrument == simulation::Instrument::GuideWire) {
    const Vec3 tip = snapshot.tip_in_patient;
    metal.push_back(fluoroscopy::make_wire(
        tip, tip + snapshot.shaft_in_patient * kGuideWireLengthMm, procedure::kWireDiameterMm));
  }
  add_screw(snapshot, metal);
  return metal;
}

}  // namespace carpus::server
