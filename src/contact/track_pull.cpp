// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/track_pull.hpp"

#include <algorithm>
#include <array>

namespace carpus::contact {
namespace {

/// Width over which a cut's edge is smoothed [mm]: a voxel of the CT.
constexpr double kEdgeMm = 0.4;

constexpr double kSqrtHalf = 0.70710678118654752;

/// Half of the ring; the other half lies opposite.
constexpr std::array<std::array<double, 2>, 4> kHalfRing{
    {{1, 0}, {kSqrtHalf, kSqrtHalf}, {0, 1}, {-kSqrtHalf, kSqrtHalf}}};

/// Length of the sum of kHalfRing: one half gone, the other whole.
constexpr double kFullPull = 2.6131259297527531;  // 1 / sin(22.5 degrees)

}  // namespace

TrackPull track_pull(const fields::CutField& cut,
                     const Point<frame::Bone>& tip,
                     const Direction<frame::Bone>& shaft,
                     double radius_mm) noexcept {
  TrackPull pull;
  if (!cut.is_cut()) return pull;
  const Vec3 u = any_perpendicular(shaft.v);
  const Vec3 v = cross(shaft.v, u);
  Vec3 sum;
  for (const auto& [along_u, along_v] : kHalfRing) {
    const Vec3 way = u * along_u + v * along_v;
    const double here = cut.removed_share(tip.v + way * radius_mm, kEdgeMm);
    const double there = cut.removed_share(tip.v - way * radius_mm, kEdgeMm);
    sum += way * (here - there);
  }
  pull.direction = {normalized_or(sum, {0, 0, 0})};
  pull.strength = std::min(length(sum) / kFullPull, 1.0);
  return pull;
}

}  // namespace carpus::contact
