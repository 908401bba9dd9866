// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/fluoroscopy/resampled_ct.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "geometry/aabb.hpp"
#include "geometry/trilinear.hpp"
#include "imaging/distance_transform.hpp"

namespace carpus::bench {
namespace {

constexpr double kBoneMarginMm = 1.2;
constexpr std::int16_t kAirHu = -1000;
constexpr std::int16_t kSoftTissueHu = 40;  // muscle; fills where a bent path would repeat a bone

/// Distance to the voxels of hand or forearm [mm].
Grid<float> distance_to(const Grid<std::uint8_t>& labels, bool forearm) {
  Grid<std::uint8_t> mask(labels.geometry());
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const std::uint8_t label = labels[i];
    if (label == kBackgroundLabel || label == kFractureGapLabel) continue;
    const bool is_forearm = label == static_cast<std::uint8_t>(BoneId::Radius) ||
                            label == static_cast<std::uint8_t>(BoneId::Ulna);
    if (is_forearm == forearm) mask[i] = 1;
  }
  return imaging::distance_to_value(std::as_const(mask).view(), 1);
}

/// Beyond the grid, the nearest voxel's plus the way to it.
double value_at(const Grid<float>& grid, const Vec3& p) {
  const GridGeometry& g = grid.geometry();
  const Vec3 v = g.voxel_from_patient(p);
  Vec3 inside;
  Vec3 away;
  for (std::size_t a = 0; a < 3; ++a) {
    inside[a] = std::clamp(v[a], 0.0, g.size[a] - 1.0);
    away[a] = (v[a] - inside[a]) * g.spacing[a];
  }
  return sample_trilinear(grid.view(), inside, 0.0) + length(away);
}

double share_of(double hand_mm, double forearm_mm) {
  const double s =
      std::clamp((hand_mm / std::max(hand_mm + forearm_mm, 1e-6) - 0.2) / 0.6, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

GridGeometry grid_for(const GridGeometry& scan, const Pose<frame::Patient, frame::Bone>& motion) {
  Aabb voxels;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 v;
    for (std::size_t a = 0; a < 3; ++a) v[a] = ((corner >> a) & 1) == 0 ? 0.0 : scan.size[a] - 1.0;
    voxels.include(v);
    voxels.include(
        scan.voxel_from_patient((motion * Point<frame::Bone>{scan.patient_from_voxel(v)}).v));
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

Pose<frame::Patient, frame::Bone> WristTurn::patient_from_forearm() const {
  const Mat3 turn = rotation_about(axis, angle_rad);
  return {turn, pivot - turn * pivot};
}

WristTurn flexion(const cases::CaseData& data, double flexion_rad) {
  const cases::Bone* capitate = cases::find_bone(data, BoneId::Capitate);
  if (capitate == nullptr) throw InvalidInput("the case has no capitate to turn the wrist about");
  const auto patient_from_wrist = data.wrist_from_patient.inverse();
  const Vec3 proximal = (patient_from_wrist * Direction<frame::Wrist>{{1, 0, 0}}).v;
  Aabb along;
  for (const Vec3& v : capitate->surface.vertices) along.include(Vec3{dot(v, proximal), 0, 0});
  // Between its proximal and middle third [clinical: S65].
  const double level = along.high.x - along.extent().x / 3;
  const Vec3 centre = centroid_of(capitate->surface);
  WristTurn turn;
  turn.pivot = centre + proximal * (level - dot(centre, proximal));
  turn.axis = (patient_from_wrist * Direction<frame::Wrist>{{0, 1, 0}}).v;
  turn.angle_rad = -flexion_rad;  // the hand stays: the forearm turns the other way
  return turn;
}

Grid<std::int16_t> resampled_ct(const cases::CaseData& data, const WristTurn& turn) {
  const Grid<float> to_hand = distance_to(data.labels, false);
  const Grid<float> to_forearm = distance_to(data.labels, true);
  const auto back = [&](const Vec3& p, double share) {
    return rotation_about(turn.axis, -turn.angle_rad * share) * (p - turn.pivot) + turn.pivot;
  };
  const GridView<const std::int16_t> scan = data.ct.view();
  const auto hu_at = [&](const Vec3& p) -> std::int16_t {
    const Vec3 with_forearm = back(p, 1.0);
    const double hand = value_at(to_hand, p);
    const double forearm = value_at(to_forearm, with_forearm);
    Vec3 source = hand <= forearm ? p : with_forearm;
    if (std::min(hand, forearm) > kBoneMarginMm) {
      source = back(p, share_of(hand, forearm));
      const double bone = std::min(value_at(to_hand, source), value_at(to_forearm, source));
      if (bone <= kBoneMarginMm) return kSoftTissueHu;
    }
    return static_cast<std::int16_t>(std::lround(sample_at(scan, source, kAirHu)));
  };
  Grid<std::int16_t> ct(grid_for(data.ct.geometry(), turn.patient_from_forearm()), kAirHu);
  const GridGeometry& g = ct.geometry();
  parallel_for(ct.values().size(), 1U << 14U, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VoxelIndex v = g.index_of(i);
      ct[i] = hu_at(g.patient_from_voxel(
          {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}));
    }
  });
  return ct;
}

Grid<std::int16_t> bones_in_one_place(const cases::CaseData& data, const WristTurn& turn) {
  const Grid<float> to_hand = distance_to(data.labels, false);
  const Grid<float> to_forearm = distance_to(data.labels, true);
  const Mat3 back = rotation_about(turn.axis, -turn.angle_rad);
  Grid<std::int16_t> both(data.ct.geometry(), kAirHu);
  const GridGeometry& g = both.geometry();
  for (std::size_t i = 0; i < both.values().size(); ++i) {
    if (to_hand[i] > kBoneMarginMm) continue;
    const VoxelIndex v = g.index_of(i);
    const Vec3 p = g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)});
    if (value_at(to_forearm, back * (p - turn.pivot) + turn.pivot) <= kBoneMarginMm) both[i] = 1000;
  }
  return both;
}

}  // namespace carpus::bench
