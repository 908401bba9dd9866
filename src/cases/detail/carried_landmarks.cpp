// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/detail/carried_landmarks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/carpal_kinematics.hpp"
#include "cases/lay_model.hpp"

namespace carpus::cases::detail {
namespace {

using anatomy::Similarity;

/// A landmark farther from its bone is left where the fit puts it [mm].
constexpr double kFarthestSnapMm = 4;
/// As far inside the volume's faces as the skin is trimmed for the eye: what is left of the caps
/// there is no skin [mm].
constexpr double kTrimMm = 1.8;
/// A facet whose normal points this much to a point is believed that the point is outside. At
/// sharp edges, slivers and folds the nearest facet may look either way: there, and where it says
/// inside, all facets are asked.
constexpr double kPlainCosine = 0.95;
/// Nearest points of the skin that lie sideways of the point asked for are its rim.
constexpr double kRimCosine = 0.5;
/// Of a soft body's way out: leads to the skin, or away from it, which would press what lies in it
/// against the bone.
constexpr double kOutwards = 0.7;
constexpr double kInwards = -0.3;
/// Between both it is left aside, or over it where that is no more than so many times as far: what
/// lies on a joint's capsule glides over it.
constexpr double kLiftForAside = 3;
/// Steps to over a soft body; nothing lies deeper under it [mm].
constexpr double kLiftStepMm = 0.25;
constexpr double kFarthestLiftMm = 6;

Vec3 unit_normal(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.facets[facet];
  const Vec3& a = mesh.vertices[t[0]];
  return normalized_or(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a), {0, 0, 1});
}

}  // namespace

WristSurfaces::WristSurfaces(const CaseData& data, std::span<const TriangleMesh* const> soft)
    : data_(data), skin_(data.skin) {
  for (const Bone& bone : data.bones) {
    bones_.push_back(
        {bone.bone, fields::ExactSurface(bone.surface), bounds_of(bone.surface.vertices)});
  }
  for (const TriangleMesh* body : soft) {
    if (check_surface(*body) != SurfaceStatus::Ok) continue;
    soft_.push_back({{}, fields::ExactSurface(*body), bounds_of(body->vertices)});
  }
}

WristSurfaces::Near WristSurfaces::near_of(const Surface& surface,
                                           const Vec3& point,
                                           const fields::NearestPoint& hit) {
  const double away = std::sqrt(hit.squared_distance);
  const Vec3 normal = unit_normal(surface.exact.surface(), hit.facet);
  const double along = dot(point - hit.point, normal);
  const bool is_outside = along > kPlainCosine * away || surface.exact.signed_distance(point) >= 0;
  return {is_outside ? away : -away, hit.point,
          normalized_or((point - hit.point) * (is_outside ? 1.0 : -1.0), normal)};
}

WristSurfaces::Near WristSurfaces::bone_near(const Vec3& point) const {
  Near near;
  near.distance_mm = std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Surface& bone : bones_) {
    const auto hit = bone.exact.tree().nearest(point, nearest);
    if (!hit || !(std::sqrt(hit->squared_distance) < nearest)) continue;
    near = near_of(bone, point, *hit);
    nearest = std::abs(near.distance_mm);
  }
  return near;
}

std::optional<double> WristSurfaces::lift_mm(const Surface& soft,
                                             const Vec3& point,
                                             const Vec3& way,
                                             double room_mm) {
  for (double mm = kLiftStepMm; mm <= kFarthestLiftMm; mm += kLiftStepMm) {
    const Vec3 there = point + way * mm;
    const auto hit = soft.exact.tree().nearest(there, room_mm);
    if (!hit) return mm;
    const Near near = near_of(soft, there, *hit);
    if (near.distance_mm > 0 && dot(near.outwards, way) > kOutwards) {
      return mm + room_mm - near.distance_mm;
    }
  }
  return std::nullopt;
}

void WristSurfaces::walls_near(const Vec3& point,
                               double radius_mm,
                               double room_mm,
                               double within_mm,
                               std::vector<Wall>& walls) const {
  walls.clear();
  for (const Surface& bone : bones_) {
    if (!bone.box.grown(within_mm).contains(point)) continue;
    const auto hit = bone.exact.tree().nearest(point);
    if (!hit) continue;
    const Near near = near_of(bone, point, *hit);
    if (near.distance_mm < within_mm) walls.push_back({near, true});
  }
  for (const Surface& body : soft_) {
    if (!body.box.grown(within_mm).contains(point)) continue;
    const auto hit = body.exact.tree().nearest(point, within_mm);
    if (!hit) continue;
    const Near near = near_of(body, point, *hit);
    walls.push_back({led_over(body, near, point, radius_mm + room_mm), false});
  }
}

Vec3 WristSurfaces::skinwards(const Vec3& point) const {
  const auto depth = depth_at(point);
  return depth ? depth->outwards : bone_near(point).outwards;
}

WristSurfaces::Near WristSurfaces::led_over(const Surface& soft,
                                            const Near& near,
                                            const Vec3& point,
                                            double room_mm) const {
  const double missing = room_mm - near.distance_mm;
  if (!(missing > 0)) return near;
  const Vec3 way = skinwards(point);
  const double along = dot(near.outwards, way);
  if (along >= kOutwards) return near;
  const auto lift = lift_mm(soft, point, way, room_mm);
  const double most = along < kInwards ? kFarthestLiftMm : kLiftForAside * missing;
  if (!lift || *lift > most) return near;
  const double distance = room_mm - *lift;
  return {distance, point - way * distance, way};
}

double WristSurfaces::nearest_mm(const Vec3& point, bool of_forearm) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Surface& bone : bones_) {
    const bool is_hand = anatomy::group_of(bone.bone) == anatomy::CarpalGroup::Hand;
    if (of_forearm ? !belongs_to_forearm(bone.bone) : !is_hand) continue;
    if (const auto hit = bone.exact.tree().nearest(point, nearest)) {
      nearest = std::min(nearest, std::sqrt(hit->squared_distance));
    }
  }
  return nearest;
}
double WristSurfaces::distance_to_forearm(const Vec3& point) const {
  return nearest_mm(point, true);
}
double WristSurfaces::distance_to_hand(const Vec3& point) const { return nearest_mm(point, false); }

bool WristSurfaces::is_in_scan(const Vec3& point) const {
  if (data_.ct.values().empty()) return true;
  const GridGeometry& volume = data_.ct.geometry();
  const Vec3 v = volume.voxel_from_patient(point);
  for (std::size_t a = 0; a < 3; ++a) {
    const double trim = kTrimMm / volume.spacing[a];
    if (!(v[a] >= trim && v[a] <= volume.size[a] - 1 - trim)) return false;
  }
  return true;
}

std::optional<WristSurfaces::Depth> WristSurfaces::depth_at(const Vec3& point) const {
  const auto hit = skin_.nearest(point);
  if (!hit || !is_in_scan(hit->point)) return std::nullopt;
  const Vec3 normal = unit_normal(data_.skin, hit->facet);
  const double away = std::sqrt(hit->squared_distance);
  const Vec3 way = point - hit->point;
  if (away > 0 && std::abs(dot(way, normal)) < kRimCosine * away) return std::nullopt;
  return Depth{dot(way, normal) < 0 ? away : -away, hit->point, normal};
}

CarriedLandmarks::CarriedLandmarks(const CaseData& data, const anatomy::StructureTable& table)
    : table_(table), mirror_(data.side == Side::Left ? 1 : -1) {
  std::array<bool, kBoneCount> is_needed{};
  for (const anatomy::Landmark& l : table.landmarks) {
    is_needed[static_cast<std::size_t>(l.bone) - 1] = true;
  }
  const LaidModel laid = lay_model(data, is_needed);
  scale_ = laid.wrist.scale;
  patient_from_model_.fill(laid.wrist);
  std::array<double, kBoneCount> misfit{};
  for (std::size_t i = 0; i < kBoneCount; ++i) {
    if (!laid.bones[i]) continue;
    patient_from_model_[i] = laid.bones[i]->patient_from_model;
    misfit[i] = laid.bones[i]->rms_mm;
  }
  worst_misfit_mm_ = *std::max_element(misfit.begin(), misfit.end());
  for (const anatomy::Landmark& l : table.landmarks) {
    const std::size_t i = static_cast<std::size_t>(l.bone) - 1;
    Vec3 point = patient_from_model_[i] * Vec3{l.at.x, mirror_ * l.at.y, l.at.z};
    double nearest = kFarthestSnapMm;
    Vec3 snapped = point;
    for (const Bone& bone : data.bones) {
      if (bone.bone != l.bone) continue;
      if (const auto hit = fields::TriangleTree(bone.surface).nearest(point, nearest)) {
        nearest = std::sqrt(hit->squared_distance);
        snapped = hit->point;
      }
    }
    landmarks_.push_back(snapped);
  }
}

Vec3 CarriedLandmarks::at(const anatomy::Place& place) const {
  const auto bone = static_cast<std::size_t>(table_.landmarks[place.landmark].bone) - 1;
  const Similarity& fit = patient_from_model_[bone];
  const Vec3 offset{place.offset.x, mirror_ * place.offset.y, place.offset.z};
  return landmarks_[place.landmark] + fit.scale * (fit.rotation * offset);
}

}  // namespace carpus::cases::detail
