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

Vec3 unit_normal(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.facets[facet];
  const Vec3& a = mesh.vertices[t[0]];
  return normalized_or(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a), {0, 0, 1});
}

}  // namespace

WristSurfaces::WristSurfaces(const CaseData& data) : data_(data), skin_(data.skin) {
  for (const Bone& bone : data.bones) {
    bones_.push_back({bone.bone, fields::ExactSurface(bone.surface)});
  }
}

WristSurfaces::Near WristSurfaces::bone_near(const Vec3& point) const {
  Near near;
  near.distance_mm = std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Surface& bone : bones_) {
    const auto hit = bone.exact.tree().nearest(point, nearest);
    if (!hit) continue;
    const double away = std::sqrt(hit->squared_distance);
    if (!(away < nearest)) continue;
    nearest = away;
    const Vec3 normal = unit_normal(bone.exact.surface(), hit->facet);
    const double along = dot(point - hit->point, normal);
    const bool is_outside = along > kPlainCosine * away || bone.exact.signed_distance(point) >= 0;
    near.distance_mm = is_outside ? away : -away;
    near.point = hit->point;
    near.outwards = normalized_or((point - hit->point) * (is_outside ? 1.0 : -1.0), normal);
  }
  return near;
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
