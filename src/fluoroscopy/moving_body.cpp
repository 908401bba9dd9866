// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/moving_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/check.hpp"
#include "core/parallel.hpp"
#include "geometry/aabb.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::fluoroscopy {
namespace {

constexpr std::size_t kSliceGrain = 2;
constexpr int kMostSamples = 8;  ///< along each axis of a voxel

/// Voxels of `to` that read anything within `box` of `from`.
IndexBox voxels_reading(const GridGeometry& to, const GridGeometry& from, const IndexBox& box) {
  Aabb reach;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 v;
    for (std::size_t a = 0; a < 3; ++a) {
      // A sample reads the voxels next to it on either side.
      v[a] = ((corner >> a) & 1) == 0 ? box.low[a] - 1.0 : static_cast<double>(box.high[a]);
    }
    reach.include(to.voxel_from_patient(from.patient_from_voxel(v)));
  }
  IndexBox result;
  for (std::size_t a = 0; a < 3; ++a) {  // and a voxel's samples lie up to half a voxel off
    const double low = std::clamp(std::floor(reach.low[a] - 0.5), 0.0, double(to.size[a]));
    const double high = std::clamp(std::ceil(reach.high[a] + 0.5) + 1, 0.0, double(to.size[a]));
    result.low[a] = static_cast<int>(low);
    result.high[a] = static_cast<int>(high);
  }
  return result;
}

}  // namespace

MovingBody::MovingBody(BodyPart part) : whole_(std::move(part.units)), volume_(whole_.view()) {}

void MovingBody::restore() {
  volume_ = AttenuationVolume(std::as_const(whole_).view());
  ++revision_;
}

void MovingBody::set_removed(const RemovedBone& removed, const IndexBox& changed) {
  const GridView<const std::uint8_t> share(removed.geometry, removed.share);
  IndexBox box = changed;
  for (std::size_t a = 0; a < 3; ++a) {
    box.low[a] = std::max(box.low[a], 0);
    box.high[a] = std::min(box.high[a], removed.geometry.size[a]);
  }
  if (box.is_empty()) return;
  const GridGeometry& g = whole_.geometry();
  const IndexBox mine = voxels_reading(g, removed.geometry, box);
  if (mine.is_empty()) return;
  std::array<int, 3> samples{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double finer = g.spacing[a] / removed.geometry.spacing[a];
    samples[a] = std::clamp(static_cast<int>(std::ceil(finer - 0.01)), 1, kMostSamples);
  }
  const double scale = 1.0 / (255.0 * samples[0] * samples[1] * samples[2]);
  const auto share_left = [&](const VoxelIndex& v) {
    double gone = 0;
    for (int k = 0; k < samples[2]; ++k) {
      for (int j = 0; j < samples[1]; ++j) {
        for (int i = 0; i < samples[0]; ++i) {
          const Vec3 at{v.x + (i + 0.5) / samples[0] - 0.5, v.y + (j + 0.5) / samples[1] - 0.5,
                        v.z + (k + 0.5) / samples[2] - 0.5};
          gone += sample_at(share, g.patient_from_voxel(at), 0.0);
        }
      }
    }
    return 1.0 - gone * scale;
  };
  parallel_for(static_cast<std::size_t>(mine.high[2] - mine.low[2]), kSliceGrain,
               [&](std::size_t begin, std::size_t end) {
                 for (int z = mine.low[2] + static_cast<int>(begin);
                      z < mine.low[2] + static_cast<int>(end); ++z) {
                   for (int y = mine.low[1]; y < mine.high[1]; ++y) {
                     for (int x = mine.low[0]; x < mine.high[0]; ++x) {
                       const std::int16_t units = whole_[VoxelIndex{x, y, z}];
                       if (units == 0) continue;
                       volume_.set_units(
                           {x, y, z},
                           static_cast<std::int16_t>(std::lround(units * share_left({x, y, z}))));
                     }
                   }
                 }
               });
  ++revision_;
}

}  // namespace carpus::fluoroscopy
