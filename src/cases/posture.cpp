// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/posture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/detail/bending.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "geometry/aabb.hpp"
#include "geometry/trilinear.hpp"

namespace carpus::cases {
namespace {

constexpr std::int16_t kAirHu = -1000;
constexpr std::int16_t kSoftTissueHu = 40;  // muscle; fills where a bent path would repeat a bone

/// Centre of rotation of the wrist: on the capitate's axis between its proximal and middle third
/// [clinical: S65].
Vec3 pivot_of(const CaseData& data) {
  const Bone* capitate = find_bone(data, BoneId::Capitate);
  if (capitate == nullptr || capitate->surface.vertices.empty()) {
    throw InvalidInput("operative posture: the case has no capitate to turn the wrist about");
  }
  const Vec3 proximal = (data.wrist_from_patient.inverse() * Direction<frame::Wrist>{{1, 0, 0}}).v;
  double low = 1e30;
  double high = -1e30;
  for (const Vec3& v : capitate->surface.vertices) {
    low = std::min(low, dot(v, proximal));
    high = std::max(high, dot(v, proximal));
  }
  const double level = high - (high - low) / 3.0;
  constexpr double kSlabShare = 0.1;
  Vec3 sum;
  double count = 0;
  for (const Vec3& v : capitate->surface.vertices) {
    if (std::abs(dot(v, proximal) - level) > kSlabShare * (high - low)) continue;
    sum += v;
    count += 1;
  }
  if (count == 0) throw InvalidInput("operative posture: the capitate's surface is broken");
  return sum / count;
}

/// The wrist's flexion axis in Patient. The wrist frame is right-handed with +x proximal and +z
/// volar on either side, so that a positive turn about its +y always takes distal to volar.
Vec3 flexion_axis(const CaseData& data) {
  return (data.wrist_from_patient.inverse() * Direction<frame::Wrist>{{0, 1, 0}}).v;
}

double distance_to_ray(const Vec3& p, const Vec3& start, const Vec3& unit) {
  const Vec3 w = p - start;
  return length(w - unit * std::max(0.0, dot(w, unit)));
}

/// A grid with the axes and spacing of `source` that holds all points of `source` and what the
/// forearm's bones and the soft tissue around them occupy once turned.
GridGeometry grid_for(const GridGeometry& source,
                      const CaseData& data,
                      const Pose<frame::Patient, frame::Bone>& patient_from_forearm) {
  constexpr double kTissueMm = 25.0;  // from a forearm bone to the skin, at most
  Aabb voxels;
  voxels.include(Vec3{0, 0, 0});
  voxels.include(Vec3{source.size[0] - 1.0, source.size[1] - 1.0, source.size[2] - 1.0});
  Aabb scan = voxels;
  Aabb forearm;
  for (const Bone& bone : data.bones) {
    if (!belongs_to_forearm(bone.bone)) continue;
    for (const Vec3& v : bone.surface.vertices) forearm.include(source.voxel_from_patient(v));
  }
  const Vec3 tissue{kTissueMm / source.spacing.x, kTissueMm / source.spacing.y,
                    kTissueMm / source.spacing.z};
  forearm.low = forearm.low - tissue;
  forearm.high = forearm.high + tissue;
  for (std::size_t axis = 0; axis < 3; ++axis) {  // what was not scanned cannot be turned
    forearm.low[axis] = std::max(forearm.low[axis], scan.low[axis]);
    forearm.high[axis] = std::min(forearm.high[axis], scan.high[axis]);
  }
  for (int corner = 0; corner < 8 && !forearm.is_empty(); ++corner) {
    const Vec3 v{(corner & 1) != 0 ? forearm.high.x : forearm.low.x,
                 (corner & 2) != 0 ? forearm.high.y : forearm.low.y,
                 (corner & 4) != 0 ? forearm.high.z : forearm.low.z};
    const Point<frame::Bone> p{source.patient_from_voxel(v)};
    voxels.include(source.voxel_from_patient((patient_from_forearm * p).v));
  }
  GridGeometry result = source;
  Vec3 first;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    first[axis] = std::floor(voxels.low[axis]);
    result.size[axis] = static_cast<int>(std::ceil(voxels.high[axis]) - first[axis]) + 1;
  }
  result.origin = source.patient_from_voxel(first);
  return result;
}

/// Resamples CT and labels along the bending.
void bend_volumes(CaseData& data, const detail::Bending& bending, const GridGeometry& geometry) {
  Grid<std::int16_t> ct(geometry, kAirHu);
  Grid<std::uint8_t> labels(geometry, kBackgroundLabel);
  const GridView<const std::int16_t> source = std::as_const(data.ct).view();
  const auto nx = static_cast<std::size_t>(geometry.size[0]);
  const auto ny = static_cast<std::size_t>(geometry.size[1]);
  parallel_for(ny * static_cast<std::size_t>(geometry.size[2]), 64,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t row = begin; row < end; ++row) {
                   for (std::size_t i = 0; i < nx; ++i) {
                     const std::size_t offset = row * nx + i;
                     const std::size_t j = row % ny;
                     const std::size_t k = row / ny;
                     const Vec3 p = geometry.patient_from_voxel(
                         {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
                     const detail::BentPoint from = bending.source_of(p);
                     const double hu = sample_at(source, from.source, kAirHu);
                     ct[offset] = from.repeats_bone
                                      ? kSoftTissueHu
                                      : static_cast<std::int16_t>(hu < 0 ? hu - 0.5 : hu + 0.5);
                     if (from.is_rigid)
                       labels[offset] = voxel_at(data.labels, from.source, kBackgroundLabel);
                   }
                 }
               });
  data.ct = std::move(ct);
  data.labels = std::move(labels);
}

}  // namespace

Posture posture_of_flexion(const CaseData& data, double flexion_rad) {
  const Vec3 pivot = pivot_of(data);
  // The hand stays: the forearm turns the other way.
  const Mat3 turn = rotation_about(flexion_axis(data), -flexion_rad);
  Posture posture;
  posture.flexion_from_scan_rad = flexion_rad;
  posture.patient_from_forearm = {turn, pivot - turn * pivot};
  return posture;
}

double approach_clearance_mm(const CaseData& data, const Posture& posture) {
  const AxisSegment& axis = data.scaphoid.central_axis;
  const Vec3 outward = normalized_or(axis.proximal - axis.distal, {0, 0, 1});
  double clearance = 1e30;
  for (const Bone& bone : data.bones) {
    if (!belongs_to_forearm(bone.bone)) continue;
    for (const Vec3& v : bone.surface.vertices) {
      const Vec3 moved = (posture.patient_from_forearm * Point<frame::Bone>{v}).v;
      clearance = std::min(clearance, distance_to_ray(moved, axis.proximal, outward));
    }
  }
  return clearance;
}

Posture choose_operative_posture(const CaseData& data) {
  Posture best;
  double best_clearance = -1;
  for (double flexion_deg = 0; flexion_deg <= kGreatestFlexionDeg; flexion_deg += kPostureStepDeg) {
    const Posture posture = posture_of_flexion(data, radians_from_degrees(flexion_deg));
    const double clearance = approach_clearance_mm(data, posture);
    if (clearance > best_clearance) {
      best = posture;
      best_clearance = clearance;
    }
    if (clearance >= kDriverClearanceMm) break;
  }
  return best;
}

CaseData apply_posture(CaseData data, const Posture& posture) {
  data.operative_posture = posture;
  if (posture.flexion_from_scan_rad == 0) return data;
  const detail::Bending bending(data.labels, pivot_of(data), flexion_axis(data),
                                posture.flexion_from_scan_rad);
  for (Vec3& v : data.skin.vertices) v = bending.target_of(v);
  const GridGeometry geometry = grid_for(data.ct.geometry(), data, posture.patient_from_forearm);
  bend_volumes(data, bending, geometry);
  for (Bone& bone : data.bones) {
    if (belongs_to_forearm(bone.bone)) bone.patient_from_bone = posture.patient_from_forearm;
  }
  return data;
}

}  // namespace carpus::cases
