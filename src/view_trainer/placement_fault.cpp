// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/placement_fault.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "view_trainer/silhouette.hpp"

namespace carpus::view_trainer {
namespace {

/// How finely a part of the envelope is looked over [mm]: its depth is then right to some 0.02 mm.
constexpr double kStepMm = 0.25;
constexpr int kAround = 40;

struct Deepest {
  double depth_mm = -1e9;
  Vec3 at;
};

/// Over the envelope between two heights, and over its flat ends.
Deepest deepest_of(const ScaphoidSurface& scaphoid,
                   const PlacedScrew& placed,
                   double from_mm,
                   double to_mm) {
  const instruments::Instrument& screw = placed.instrument();
  const Vec3 a = any_perpendicular(placed.shaft);
  const Vec3 b = cross(placed.shaft, a);
  Deepest deepest;
  const auto look_at_ring = [&](double z, double share) {
    const double along = z / screw.length_mm;
    const double radius =
        share * (screw.tip_diameter_mm * (1 - along) + screw.tail_diameter_mm * along) / 2;
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      const Vec3 p =
          placed.tip + placed.shaft * z + (a * std::cos(angle) + b * std::sin(angle)) * radius;
      const double depth = scaphoid.signed_distance(p);
      if (depth > deepest.depth_mm) deepest = {depth, p};
    }
  };
  const int steps = std::max(1, static_cast<int>(std::ceil((to_mm - from_mm) / kStepMm)));
  for (int i = 0; i <= steps; ++i) look_at_ring(from_mm + (to_mm - from_mm) * i / steps, 1.0);
  for (const double share : {0.0, 0.35, 0.7}) {
    if (from_mm <= 0.0) look_at_ring(0.0, share);
    if (to_mm >= screw.length_mm) look_at_ring(screw.length_mm, share);
  }
  return deepest;
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
    const Deepest deepest = deepest_of(scaphoid, placed, part.from_mm, part.to_mm);
    if (!(deepest.depth_mm > kOutMm)) continue;
    part.depth_mm = deepest.depth_mm;
    part.towards = scaphoid.neighbour_at(deepest.at);
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
