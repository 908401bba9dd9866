// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The nearest vertex of the wall to where the generic wrist has the point, or to what it lies on.
#include "arthroscopy/detail/tour_places.hpp"

#include <array>
#include <cstddef>
#include <vector>

#include "arthroscopy/detail/scanned_bones.hpp"

namespace carpus::arthroscopy::detail {
namespace {

using soft_tissue::Lining;

/// A place between two bones so much nearer to both is taken for each mm away from the usual [E].
constexpr double kPerMmAside = 0.15;

/// The bone's body; of a broken one the part on the joint's side, proximal.
std::optional<std::uint8_t> body_at(const cases::CaseData& data, BoneId bone) {
  const cases::Bone* found = cases::find_bone(data, bone);
  if (found == nullptr) found = cases::find_bone(data, bone, BonePart::Proximal);
  if (found == nullptr) return std::nullopt;
  return static_cast<std::uint8_t>(found - data.bones.data());
}

/// Where two bones' surfaces come nearest to the joint's wall at once, not far from a place.
std::optional<Vec3> between(const cases::CaseData& data,
                            const SpaceWalls& walls,
                            const std::array<BoneId, 2>& bones,
                            const Vec3& near) {
  std::optional<Vec3> best;
  double least = 1e18;
  for (const Vec3& v : walls.space->surface.vertices) {
    double cost = kPerMmAside * distance(v, near);
    for (const BoneId bone : bones) cost += distance_mm_to(data, bone, v);
    if (cost >= least) continue;
    least = cost;
    best = v;
  }
  for (const BoneId bone : bones) {
    if (best && distance_mm_to(data, bone, *best) >= kFarMm) return std::nullopt;
  }
  return best;
}

}  // namespace

std::optional<Vec3> TourPlaces::place_of(const TabledPoint& point, std::uint8_t joint) const {
  const SpaceWalls& walls = walls_[joint];
  if (point.on) {
    const auto body = body_at(data_, *point.on);
    if (!body) return std::nullopt;
    // Where no other bone or disc came near in any posture, cartilage was not made.
    const Vec3 near = axes_.point(point.at);
    const auto cartilage = on_wall(walls, near, Lining::Cartilage, body);
    return cartilage ? cartilage : on_wall(walls, near, std::nullopt, body);
  }
  if (point.between) return between(data_, walls, *point.between, axes_.point(point.at));
  if (point.is_place) return on_wall(walls, axes_.point(point.at), std::nullopt);
  if (point.is_disc) {
    if (tissue_.disc.middle.vertices.empty()) return std::nullopt;
    Vec3 sum;
    for (const Vec3& v : tissue_.disc.middle.vertices) sum += v;
    return on_wall(walls, sum / static_cast<double>(tissue_.disc.middle.vertices.size()),
                   Lining::Disc);
  }
  for (const soft_tissue::Ligament& l : tissue_.ligaments) {
    if (l.id != point.ligament || l.strands.empty()) continue;
    const std::vector<Vec3>& course = l.strands[l.strands.size() / 2].course;
    const double at = point.fraction * static_cast<double>(course.size() - 1);
    return on_wall(walls, course[static_cast<std::size_t>(at + 0.5)], std::nullopt);
  }
  return std::nullopt;
}

}  // namespace carpus::arthroscopy::detail
