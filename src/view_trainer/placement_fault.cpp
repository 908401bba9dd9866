// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/placement_fault.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "instruments/screw_envelope.hpp"
#include "view_trainer/silhouette.hpp"

namespace carpus::view_trainer {
namespace {

/// Of the envelope between two heights over its tip.
instruments::DeepestPlace deepest_of(const ScaphoidSurface& scaphoid,
                                     const PlacedScrew& placed,
                                     double from_mm,
                                     double to_mm) {
  const instruments::Instrument& screw = placed.instrument();
  const instruments::ScrewEnvelope envelope{placed.tail(), placed.tip, screw.tail_diameter_mm / 2,
                                            screw.tip_diameter_mm / 2};
  return instruments::farthest_outside(envelope, 1 - to_mm / screw.length_mm,
                                       1 - from_mm / screw.length_mm,
                                       [&](const Vec3& p) { return scaphoid.signed_distance(p); });
}

}  // namespace

std::vector<PlacementFault> faults_of(const ScaphoidSurface& scaphoid, const PlacedScrew& placed) {
  const double length = placed.instrument().length_mm;
  const double end = std::min(kPoleMm, length / 3);
  const auto& axis = scaphoid.data().scaphoid.central_axis;
  // Which end is which pole, the axis tells.
  const bool tip_is_distal = dot(axis.distal - axis.proximal, -placed.shaft) > 0;
  const std::array<PlacementFault, 3> parts{
      PlacementFault{tip_is_distal ? Region::Distal : Region::Proximal, 0, 0, end, {}},
      PlacementFault{
          tip_is_distal ? Region::Proximal : Region::Distal, 0, length - end, length, {}},
      PlacementFault{Region::Side, 0, end, length - end, {}}};
  std::vector<PlacementFault> faults;
  for (PlacementFault part : parts) {
    const instruments::DeepestPlace deepest =
        deepest_of(scaphoid, placed, part.from_mm, part.to_mm);
    if (!(deepest.outside_mm > kOutMm)) continue;
    part.depth_mm = deepest.outside_mm;
    part.towards = scaphoid.neighbour_at(deepest.point);
    faults.push_back(std::move(part));
  }
  std::sort(faults.begin(), faults.end(),
            [](const auto& x, const auto& y) { return x.depth_mm > y.depth_mm; });
  return faults;
}

double overhang_of(const PlacementFault& fault,
                   const PlacedScrew& placed,
                   const OutlineMap& bone,
                   const PosedView& view) {
  return bone.overhang_of(screw_part_outline(placed, fault.from_mm, fault.to_mm, view));
}

}  // namespace carpus::view_trainer
