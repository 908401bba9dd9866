// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/detail/bending.hpp"

#include <algorithm>
#include <cmath>

#include "anatomy/bone_id.hpp"
#include "imaging/distance_transform.hpp"

namespace carpus::cases::detail {
namespace {

constexpr double kCoarseMm = 0.6;      // distances need no finer grid: the margin is twice as wide
constexpr double kBoneMarginMm = 1.2;  // covers the blurred edge of cortical bone on CT
constexpr double kFarMm = 1e3;         // beyond the grid

bool is_forearm_label(std::uint8_t label) {
  return label == static_cast<std::uint8_t>(BoneId::Radius) ||
         label == static_cast<std::uint8_t>(BoneId::Ulna);
}

/// Geometry with at most every k-th voxel, so that spacing is about kCoarseMm, and the factors.
GridGeometry coarse_geometry(const GridGeometry& fine, std::array<int, 3>& factor) {
  GridGeometry coarse = fine;
  Vec3 first;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    factor[axis] = std::max(1, static_cast<int>(std::lround(kCoarseMm / fine.spacing[axis])));
    coarse.size[axis] = (fine.size[axis] + factor[axis] - 1) / factor[axis];
    coarse.spacing[axis] = fine.spacing[axis] * factor[axis];
    first[axis] = 0.5 * (factor[axis] - 1);
  }
  coarse.origin = fine.patient_from_voxel(first);
  return coarse;
}

/// Distance to the marked voxels [mm].
Grid<float> distance_from(const Grid<unsigned char>& mask) {
  Grid<float> distance = imaging::distance_to_value(mask.view(), 1);
  for (float& value : distance.values()) value = std::min(value, static_cast<float>(kFarMm));
  return distance;
}

/// Distance at `p`; beyond the grid, the nearest voxel's plus the way to it.
double value_at(const Grid<float>& grid, const Vec3& p) {
  const GridGeometry& g = grid.geometry();
  const Vec3 v = g.voxel_from_patient(p);
  VoxelIndex nearest;
  double outside = 0;
  const auto clamp_axis = [&](double value, int size, double spacing) {
    const double clamped = std::clamp(value, 0.0, size - 1.0);
    const double away = (value - clamped) * spacing;
    outside += away * away;
    return static_cast<int>(std::lround(clamped));
  };
  nearest.x = clamp_axis(v.x, g.size[0], g.spacing.x);
  nearest.y = clamp_axis(v.y, g.size[1], g.spacing.y);
  nearest.z = clamp_axis(v.z, g.size[2], g.spacing.z);
  return static_cast<double>(grid[nearest]) + (outside > 0 ? std::sqrt(outside) : 0.0);
}

/// Share of the rotation from the distances to the nearest bones of hand and forearm: 0 in the
/// fifth of the way next to the hand, 1 in the fifth next to the forearm, smooth between.
double share_of(double hand_mm, double forearm_mm) {
  const double s =
      std::clamp((hand_mm / std::max(hand_mm + forearm_mm, 1e-6) - 0.2) / 0.6, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

}  // namespace

Bending::Bending(const Grid<std::uint8_t>& labels,
                 const Vec3& pivot,
                 const Vec3& axis,
                 double flexion_rad)
    : pivot_(pivot) {
  std::array<int, 3> factor{};
  const GridGeometry coarse = coarse_geometry(labels.geometry(), factor);
  Grid<unsigned char> hand(coarse);
  Grid<unsigned char> forearm(coarse);
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const std::uint8_t label = labels[i];
    if (label == kBackgroundLabel || label == kFractureGapLabel) continue;
    const VoxelIndex v = labels.geometry().index_of(i);
    const VoxelIndex c{v.x / factor[0], v.y / factor[1], v.z / factor[2]};
    (is_forearm_label(label) ? forearm : hand)[c] = 1;
  }
  to_hand_ = distance_from(hand);
  to_forearm_ = distance_from(forearm);
  for (int i = 0; i <= kShares; ++i) {
    turn_back_[static_cast<std::size_t>(i)] = rotation_about(axis, flexion_rad * i / kShares);
  }
}

Vec3 Bending::turned_back(const Vec3& target, double share) const noexcept {
  const auto i = static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * kShares));
  return turn_back_[i] * (target - pivot_) + pivot_;
}

double Bending::share_at(const Vec3& target) const noexcept {
  return share_of(value_at(to_hand_, target), value_at(to_forearm_, turned_back(target, 1.0)));
}

BentPoint Bending::source_of(const Vec3& target) const noexcept {
  const Vec3 with_forearm = turned_back(target, 1.0);
  const double hand = value_at(to_hand_, target);
  const double forearm = value_at(to_forearm_, with_forearm);
  if (std::min(hand, forearm) <= kBoneMarginMm) {
    return {hand <= forearm ? target : with_forearm, true, false};
  }
  // The source must not lie in a bone that is elsewhere by now. Where it moves with one side
  // wholly, only the other side's bones can be met.
  const double share = share_of(hand, forearm);
  if (share <= 0) return {target, false, value_at(to_forearm_, target) <= kBoneMarginMm};
  if (share >= 1) return {with_forearm, false, value_at(to_hand_, with_forearm) <= kBoneMarginMm};
  BentPoint point;
  point.source = turned_back(target, share);
  point.repeats_bone = std::min(value_at(to_hand_, point.source),
                                value_at(to_forearm_, point.source)) <= kBoneMarginMm;
  return point;
}

Vec3 Bending::target_of(const Vec3& source) const noexcept {
  constexpr int kIterations = 12;
  Vec3 target = source;
  for (int i = 0; i < kIterations; ++i) {
    const auto k = static_cast<std::size_t>(std::lround(share_at(target) * kShares));
    const Vec3 next = turn_back_[k].transposed() * (source - pivot_) + pivot_;
    // Half steps where the map is steep: the full one may swing between hand and forearm.
    target = i < 4 ? next : (target + next) * 0.5;
  }
  return target;
}

}  // namespace carpus::cases::detail
