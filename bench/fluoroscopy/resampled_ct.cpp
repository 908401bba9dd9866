// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/fluoroscopy/resampled_ct.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "geometry/aabb.hpp"
#include "geometry/trilinear.hpp"
#include "imaging/distance_transform.hpp"

namespace carpus::bench {
namespace {

using BonePose = Pose<frame::Patient, frame::Bone>;

constexpr double kBoneMarginMm = 1.2;
constexpr int kBoxMargin = 8;  // voxels around a bone
constexpr double kFarMm = 1e3;
constexpr std::int16_t kAirHu = -1000;
constexpr std::int16_t kSoftTissueHu = 40;  // muscle; fills where a bent path would repeat a bone
/// Voxels that are read between voxels blur what they hold once more, cortex most of all. Half as
/// wide as the scan's they do so a quarter as much.
constexpr int kVoxelsPerScanned = 2;
constexpr std::size_t kGrain = 1U << 14U;

/// Distance to one bone on the part of the scan around it.
Grid<float> distance_around(const Grid<std::uint8_t>& labels, std::uint8_t label) {
  const GridGeometry& scan = labels.geometry();
  std::array<int, 3> low = scan.size;
  std::array<int, 3> high{-1, -1, -1};
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    if (labels[i] != label) continue;
    const VoxelIndex v = scan.index_of(i);
    const std::array<int, 3> at{v.x, v.y, v.z};
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], at[a]);
      high[a] = std::max(high[a], at[a]);
    }
  }
  if (high[0] < 0) return {};
  GridGeometry box = scan;
  Vec3 first;
  for (std::size_t a = 0; a < 3; ++a) {
    low[a] -= kBoxMargin;
    first[a] = low[a];
    box.size[a] = high[a] + kBoxMargin + 1 - low[a];
  }
  box.origin = scan.patient_from_voxel(first);
  Grid<std::uint8_t> mask(box);
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    VoxelIndex v = box.index_of(i);
    v = {v.x + low[0], v.y + low[1], v.z + low[2]};
    if (scan.contains(v) && labels[scan.offset_of(v)] == label) mask[i] = 1;
  }
  return imaging::distance_to_value(std::as_const(mask).view(), 1);
}

Vec3 place_of(const GridGeometry& grid, std::size_t index) {
  const VoxelIndex v = grid.index_of(index);
  return grid.patient_from_voxel(
      {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
}

std::vector<Pose<frame::Bone, frame::Patient>> inverses_of(std::span<const BonePose> poses) {
  std::vector<Pose<frame::Bone, frame::Patient>> back;
  for (const BonePose& pose : poses) back.push_back(pose.inverse());
  return back;
}

/// Holds the scan at each of the poses.
GridGeometry grid_for(GridGeometry scan, std::span<const BonePose> poses) {
  for (std::size_t a = 0; a < 3; ++a) {
    scan.size[a] = (scan.size[a] - 1) * kVoxelsPerScanned + 1;
    scan.spacing[a] /= kVoxelsPerScanned;
  }
  Aabb voxels;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 v;
    for (std::size_t a = 0; a < 3; ++a) v[a] = ((corner >> a) & 1) == 0 ? 0.0 : scan.size[a] - 1.0;
    const Point<frame::Bone> scanned{scan.patient_from_voxel(v)};
    for (const BonePose& pose : poses) voxels.include(scan.voxel_from_patient((pose * scanned).v));
  }
  GridGeometry result = scan;
  Vec3 first;
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] = std::floor(voxels.low[a]);
    result.size[a] = static_cast<int>(std::ceil(voxels.high[a]) - first[a]) + 1;
  }
  result.origin = scan.patient_from_voxel(first);
  return result;
}

}  // namespace

RigidBones::RigidBones(const cases::CaseData& data) : data_(data) {
  for (const cases::Bone& bone : data.bones) {
    distances_.push_back(distance_around(data.labels, bone.label));
  }
}

double RigidBones::distance_mm(std::size_t bone, const Vec3& scanned) const {
  const Grid<float>& field = distances_[bone];
  if (field.values().empty()) return kFarMm;
  const Vec3 v = field.geometry().voxel_from_patient(scanned);
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(v[a] >= 0 && v[a] <= field.geometry().size[a] - 1)) return kFarMm;
  }
  return sample_trilinear(field.view(), v, kFarMm);
}

bool RigidBones::is_in_bone(const Vec3& scanned) const {
  for (std::size_t b = 0; b < distances_.size(); ++b) {
    if (distance_mm(b, scanned) <= kBoneMarginMm) return true;
  }
  return false;
}

/// In the scan that place belonged to a neighbour: it goes with that one.
bool RigidBones::is_anothers(std::size_t bone, const Vec3& scanned) const {
  const double own = distance_mm(bone, scanned);
  for (std::size_t b = 0; b < distances_.size(); ++b) {
    if (b != bone && distance_mm(b, scanned) < own) return true;
  }
  return false;
}

Grid<std::int16_t> RigidBones::resampled_ct(const fluoroscopy::TissueBending& bending,
                                            std::span<const BonePose> poses) const {
  const fluoroscopy::BentTissue tissue(bending, poses);
  const auto back = inverses_of(poses);
  const GridView<const std::int16_t> scan = data_.ct.view();
  Grid<std::int16_t> ct(grid_for(data_.ct.geometry(), poses), kAirHu);
  const GridGeometry& g = ct.geometry();
  const auto hu_at = [&](const Point<frame::Patient>& now) {
    double nearest = kBoneMarginMm;
    std::optional<Vec3> scanned;
    for (std::size_t b = 0; b < back.size(); ++b) {
      const Vec3 in_bone = (back[b] * now).v;
      const double distance = distance_mm(b, in_bone);
      if (!(distance <= nearest) || is_anothers(b, in_bone)) continue;
      nearest = distance;
      scanned = in_bone;
    }
    if (!scanned) {
      scanned = tissue.source_of(now);
      if (is_in_bone(*scanned)) return kSoftTissueHu;
    }
    return static_cast<std::int16_t>(std::lround(sample_at(scan, *scanned, kAirHu)));
  };
  parallel_for(ct.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ct[i] = hu_at({place_of(g, i)});
  });
  return ct;
}

Grid<std::int16_t> RigidBones::bones_in_one_place(std::span<const BonePose> poses) const {
  const auto back = inverses_of(poses);
  Grid<std::int16_t> both(data_.ct.geometry(), kAirHu);
  const GridGeometry& g = both.geometry();
  parallel_for(both.values().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point<frame::Patient> now{place_of(g, i)};
      int bones = 0;
      for (std::size_t b = 0; b < back.size(); ++b) {
        const Vec3 in_bone = (back[b] * now).v;
        if (distance_mm(b, in_bone) > 0) continue;
        ++bones;
      }
      if (bones > 1) both[i] = 1000;
    }
  });
  return both;
}

}  // namespace carpus::bench
