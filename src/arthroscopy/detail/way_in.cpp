// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A line is followed in steps, from outside until it has come to the working depth or left the
// joint as it is pulled open; its room is the least distance to a bone on the way.
#include "arthroscopy/detail/way_in.hpp"

#include <algorithm>

#include "arthroscopy/detail/scanned_bones.hpp"
#include "arthroscopy/opened_space.hpp"
#include "geometry/segment_distance.hpp"

namespace carpus::arthroscopy::detail {
namespace {

constexpr double kStepMm = 0.25;
constexpr double kFarStepMm = 0.5;  // where the joint is not near
/// Before the capsule bones leave a scope so much: a hand is not led as straight as a line [E].
constexpr double kBeforeRoomMm = 1.4;
/// A scope's tip looks about from so far beyond the capsule at least [E]; farther in, where the
/// convex row lies nearer to the radius, bone stops it.
constexpr double kWorkingMm = 4.0;
constexpr double kLeastWayMm = 3.0;
/// Two holes of 2.5 mm each (simulation) that do not touch, from the capsule to outside: nearer to
/// each other a scope could not tell by which it goes in [E]. The tour's portals keep so far apart
/// where there is room, the others always.
constexpr double kApartMm = 5.5;
constexpr double kOutsideMm = 20.0;

}  // namespace

std::optional<WayIn> way_in(const cases::JointSpace& joint,
                            const PulledBones& bones,
                            const Vec3& from,
                            const Vec3& inwards,
                            double stop_below_mm) {
  std::optional<WayIn> way;
  double in = 0;
  double step = kStepMm;
  for (double s = 0; s < 30; s += step) {
    const Vec3 p = from + inwards * s;
    const OpenedSpace wall =
        opened_space_at(joint.wall, bones.inverse(joint.proximal), bones.inverse(joint.distal), p);
    const bool is_in = wall.is_near && wall.distance_mm < 0;
    step = wall.is_near ? kStepMm : kFarStepMm;
    if (!way) {
      if (!is_in && bones.distance_mm(p, kBeforeRoomMm) < kBeforeRoomMm)
        return std::nullopt;  // bone
      if (!is_in) continue;
      way = WayIn{p, inwards, kFarMm};
    }
    if (!is_in || in > kWorkingMm) break;
    way->room_mm = bones.distance_mm(p, way->room_mm);
    if (way->room_mm < stop_below_mm) return std::nullopt;
    in += kStepMm;
  }
  // A line that leaves the space at once only grazes it.
  if (way && in < kLeastWayMm) way.reset();
  return way;
}

double past_mm(const WayIn& way, const Vec3& point) {
  const Vec3 to = point - way.capsule;
  return length(to - way.inwards * std::max(0.0, dot(to, way.inwards)));
}

bool share_hole(const WayIn& a, const WayIn& b) {
  return segment_distance(a.capsule, a.capsule - a.inwards * kOutsideMm, b.capsule,
                          b.capsule - b.inwards * kOutsideMm) < kApartMm;
}

}  // namespace carpus::arthroscopy::detail
