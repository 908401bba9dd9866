// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "fields/distance_field.hpp"

namespace carpus::soft_tissue::detail {
namespace {

/// Where the field says no more than this, the nearest facet tells the side.
constexpr double kFieldTellsSideMm = 0.3;
/// Beyond the fields' grids nothing is asked for more than this.
constexpr double kBandMm = 4.0;
constexpr int kPushes = 6;

}  // namespace

Vec3 facet_normal(const TriangleMesh& mesh, std::uint32_t facet) {
  const Triangle& t = mesh.facets[facet];
  const Vec3& a = mesh.vertices[t[0]];
  return normalized_or(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a), {0, 0, 1});
}

Surroundings::Surroundings(const cases::CaseData& data) : data_(data) {
  own_fields_.resize(data.bones.size());
  for (std::size_t i = 0; i < data.bones.size(); ++i) {
    const cases::Bone& bone = data.bones[i];
    trees_.emplace_back(bone.surface);
    boxes_.push_back(bounds_of(bone.surface.vertices));
    if (bone.distance_field.values().empty()) {
      own_fields_[i] = fields::build_distance_field(bone.surface);
    }
  }
}

const Grid<float>& Surroundings::field(std::size_t bone) const {
  return own_fields_[bone].values().empty() ? data_.bones[bone].distance_field : own_fields_[bone];
}

double Surroundings::distance_mm(std::size_t bone, const Vec3& point) const {
  if (!boxes_[bone].grown(kBandMm).contains(point)) return kBandMm;
  return fields::sample_distance(field(bone), point).distance_mm;
}

Surroundings::Near Surroundings::near(const Vec3& point) const {
  Near near{kBandMm, {}, 0};
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].grown(kBandMm).contains(point)) continue;
    const fields::DistanceSample sample = fields::sample_distance(field(i), point);
    if (sample.distance_mm < near.distance_mm) {
      near = {sample.distance_mm, normalized_or(sample.gradient, {}), i};
    }
  }
  return near;
}

double Surroundings::exact_mm(std::size_t bone, const Vec3& point, double limit_mm) const {
  if (!boxes_[bone].grown(limit_mm).contains(point)) return limit_mm;
  const double rough = distance_mm(bone, point);
  const auto hit =
      trees_[bone].nearest(point, rough > 0 ? limit_mm : std::numeric_limits<double>::infinity());
  if (!hit) return limit_mm;
  const double away = std::sqrt(hit->squared_distance);
  const bool is_outside =
      std::abs(rough) > kFieldTellsSideMm
          ? rough > 0
          : dot(point - hit->point, facet_normal(data_.bones[bone].surface, hit->facet)) >= 0;
  return is_outside ? std::min(away, limit_mm) : -away;
}

Vec3 Surroundings::with_room(Vec3 point, double room_mm) const {
  for (int push = 0; push < kPushes; ++push) {
    const Near at = near(point);
    if (at.distance_mm >= room_mm) break;
    point += at.outwards * (room_mm - at.distance_mm);
  }
  return point;
}

Vec3 Surroundings::with_exact_room(Vec3 point, double room_mm) const {
  for (int push = 0; push < kPushes; ++push) {
    bool was_pushed = false;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const double away = exact_mm(i, point, room_mm);
      if (away >= room_mm) continue;
      const auto hit = trees_[i].nearest(point);
      const Vec3 out = std::abs(away) > 1e-6 ? (point - hit->point) / away
                                             : facet_normal(data_.bones[i].surface, hit->facet);
      point = hit->point + out * room_mm;
      was_pushed = true;
    }
    if (!was_pushed) break;
  }
  return point;
}

double Surroundings::deepest_mm(const std::vector<Vec3>& points) const {
  double deepest = 0;
  for (const Vec3& p : points) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      deepest = std::max(deepest, -exact_mm(i, p, 0.01));
    }
  }
  return deepest;
}

std::optional<Surroundings::OnBone> Surroundings::on_bone(BoneId bone, const Vec3& point) const {
  std::optional<OnBone> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < trees_.size(); ++i) {
    if (data_.bones[i].bone != bone) continue;
    const auto hit = trees_[i].nearest(point, nearest);
    if (!hit) continue;
    nearest = std::sqrt(hit->squared_distance);
    best = {hit->point, facet_normal(data_.bones[i].surface, hit->facet), i};
  }
  return best;
}

}  // namespace carpus::soft_tissue::detail
