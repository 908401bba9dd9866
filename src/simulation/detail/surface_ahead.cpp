// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bone that a free instrument comes near: a device is told of it before it is touched.
#include <algorithm>
#include <cstdint>

#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {
namespace {

/// Farther from bone nothing is asked about what faces it [mm].
constexpr double kNearMm = 3.0;
/// Half way to what may face it [mm].
constexpr double kHalfGapMm = 1.5;

}  // namespace

/// @param front  centre of the instrument's foremost ball, of this radius. @param surface  there.
SurfaceAhead World::State::surface_ahead(const Vec3& front,
                                         double radius_mm,
                                         const Touched& surface) const noexcept {
  SurfaceAhead ahead;
  if (surface.body == kNoBody || !(surface.distance_mm - radius_mm < kNearMm)) return ahead;
  if (!(squared_length(surface.normal_in_patient) > 0.5)) return ahead;
  // In and beside a hole the surface as scanned is no wall.
  const Vec3 local = (inverses[surface.body] * Point<frame::Patient>{front}).v;
  const fields::CutField& cut = tissue.cuts().field(surface.body);
  if (cut.is_cut() && cut.sample(local) > surface.distance_mm - radius_mm) return ahead;
  ahead.body = surface.body;
  ahead.gap_mm = surface.distance_mm - radius_mm;
  ahead.normal_in_patient = surface.normal_in_patient;
  const Vec3 on_surface = front - surface.normal_in_patient * surface.distance_mm;
  const Vec3 half_way = on_surface + surface.normal_in_patient * kHalfGapMm;
  for (std::uint8_t b = 0; b < snapshot.body_count; ++b) {
    if (b == surface.body) continue;
    const Vec3 there = (inverses[b] * Point<frame::Patient>{half_way}).v;
    if (!tissue.is_near(b, there)) continue;
    ahead.facing_mm =
        std::min(ahead.facing_mm, kHalfGapMm + tissue.untouched_distance_mm(b, there));
  }
  return ahead;
}

}  // namespace carpus::simulation
