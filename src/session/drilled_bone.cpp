// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/drilled_bone.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/aabb.hpp"

namespace carpus::session {

namespace {

using simulation::TrackView;

constexpr double kVoxelMm = 0.4;
constexpr int kSamples = 3;  // along each axis of a voxel
constexpr double kVoxelDiagonalMm = 1.7321 * kVoxelMm;

/// How far a point lies inside a way; negative outside, to first order in the taper.
double depth_inside(const TrackView& track, const Vec3& point) noexcept {
  const Vec3 along = track.to_in_bone - track.from_in_bone;
  const double squared = squared_length(along);
  if (!(squared > 0.0)) return track.from_radius_mm - distance(point, track.from_in_bone);
  const double at = std::clamp(dot(point - track.from_in_bone, along) / squared, 0.0, 1.0);
  const double radius = track.from_radius_mm + at * (track.to_radius_mm - track.from_radius_mm);
  return radius - distance(point, track.from_in_bone + along * at);
}

double deepest(std::span<const TrackView> tracks, const Vec3& point) noexcept {
  double depth = -1e9;
  for (const TrackView& track : tracks) depth = std::max(depth, depth_inside(track, point));
  return depth;
}

GridGeometry grid_around(std::span<const TrackView> tracks) {
  Aabb box;
  double widest = 0.0;
  for (const TrackView& track : tracks) {
    box.include(track.from_in_bone);
    box.include(track.to_in_bone);
    widest = std::max({widest, track.from_radius_mm, track.to_radius_mm});
  }
  const double margin = widest + kVoxelMm;
  GridGeometry geometry;
  geometry.spacing = {kVoxelMm, kVoxelMm, kVoxelMm};
  geometry.origin = box.low - Vec3{margin, margin, margin};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = box.high[axis] - box.low[axis] + 2 * margin;
    geometry.size[axis] = static_cast<int>(std::ceil(extent / kVoxelMm)) + 1;
  }
  return geometry;
}

std::uint8_t share_at(std::span<const TrackView> tracks, const Vec3& centre) noexcept {
  const double depth = deepest(tracks, centre);
  if (depth >= kVoxelDiagonalMm / 2) return 255;
  if (depth <= -kVoxelDiagonalMm / 2) return 0;
  int inside = 0;
  const auto offset = [](int i) { return (i + 0.5) / kSamples - 0.5; };
  for (int z = 0; z < kSamples; ++z) {
    for (int y = 0; y < kSamples; ++y) {
      for (int x = 0; x < kSamples; ++x) {
        const Vec3 sample = centre + Vec3{offset(x), offset(y), offset(z)} * kVoxelMm;
        inside += deepest(tracks, sample) > 0.0 ? 1 : 0;
      }
    }
  }
  return static_cast<std::uint8_t>(255 * inside / (kSamples * kSamples * kSamples));
}

}  // namespace

Grid<std::uint8_t> removed_share(std::span<const TrackView> tracks) {
  if (tracks.empty()) return {};
  Grid<std::uint8_t> share(grid_around(tracks));
  const GridGeometry& geometry = share.geometry();
  for (std::size_t i = 0; i < geometry.voxel_count(); ++i) {
    const VoxelIndex v = geometry.index_of(i);
    share[i] = share_at(
        tracks, geometry.patient_from_voxel({static_cast<double>(v.x), static_cast<double>(v.y),
                                             static_cast<double>(v.z)}));
  }
  return share;
}

}  // namespace carpus::session
