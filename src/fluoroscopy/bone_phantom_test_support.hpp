// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Balls and boxes of bone in a limb of soft tissue, on a grid, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/pose.hpp"

namespace carpus::fluoroscopy::test {

/// Signed distance of a solid [mm], negative inside.
using Solid = std::function<double(const Vec3&)>;

[[nodiscard]] inline Solid ball(const Vec3& centre, double radius) {
  return [=](const Vec3& p) { return distance(p, centre) - radius; };
}

/// Rounded at its corners only outside.
[[nodiscard]] inline Solid box(const Vec3& centre, const Vec3& half) {
  return [=](const Vec3& p) {
    const Vec3 q{std::abs(p.x - centre.x) - half.x, std::abs(p.y - centre.y) - half.y,
                 std::abs(p.z - centre.z) - half.z};
    const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
  };
}

[[nodiscard]] inline Solid moved(Solid solid, const Pose<frame::Patient, frame::Bone>& pose) {
  const auto back = pose.inverse();
  return [solid = std::move(solid), back](const Vec3& p) {
    return solid((back * Point<frame::Patient>{p}).v);
  };
}

struct Phantom {
  Grid<std::int16_t> ct;
  Grid<std::uint8_t> labels;  ///< bones count from 1
};

/// Centred in Patient's origin; edges are a voxel wide, as a scan's are.
[[nodiscard]] inline Phantom make_phantom(int side,
                                          double voxel_mm,
                                          const std::vector<Solid>& bones,
                                          double bone_hu,
                                          const Solid& limb,
                                          double limb_hu) {
  GridGeometry g;
  g.size = {side, side, side};
  g.spacing = {voxel_mm, voxel_mm, voxel_mm};
  const double low = -0.5 * (side - 1) * voxel_mm;
  g.origin = {low, low, low};
  Phantom phantom{Grid<std::int16_t>(g), Grid<std::uint8_t>(g)};
  for (std::size_t i = 0; i < g.voxel_count(); ++i) {
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    const auto share = [&](double d) { return std::clamp(0.5 - d / voxel_mm, 0.0, 1.0); };
    double hu = -1000 + share(limb(p)) * (limb_hu + 1000);
    for (std::size_t b = 0; b < bones.size(); ++b) {
      const double d = bones[b](p);
      hu += share(d) * (bone_hu - hu);
      if (d <= 0) phantom.labels[i] = static_cast<std::uint8_t>(b + 1);
    }
    phantom.ct[i] = static_cast<std::int16_t>(std::lround(hu));
  }
  return phantom;
}

}  // namespace carpus::fluoroscopy::test
