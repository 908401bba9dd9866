// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scripted arthroscopist goes by in a joint: where portals and places are as the wrist is
// pulled, where an instrument has room, and from where a place is seen with least movement, found
// by trying many.
#include <algorithm>
#include <cmath>

#include "arthroscopy/opened_space.hpp"
#include "fields/distance_field.hpp"
#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr double kDeepestMm = 14.0;      // of the working depth [S81]
constexpr double kBehindMm = 0.6;        // of the wall: so far its grid is off
constexpr double kInFieldCosine = 0.08;  // more than half the field's: not at its rim
constexpr double kTurnStepDeg = 15.0;
constexpr double kSpareMm = 0.1;  // about the scope

double wrapped(double deg) { return deg > 180 ? deg - 360 : (deg < -180 ? deg + 360 : deg); }

}  // namespace

/// The hole in the skin where it is now.
HandPose ScriptedArthroscopist::hole(std::uint8_t portal) const {
  const cases::Portal& p = map_.portals[portal];
  return {(poses_[p.body] * Point<frame::Bone>{p.skin}).v,
          -(poses_[p.body] * Direction<frame::Bone>{p.inwards}).v};
}

Vec3 ScriptedArthroscopist::place_of(std::size_t point) const { return moved(map_.points[point]); }

Vec3 ScriptedArthroscopist::moved(const cases::TourPoint& point) const {
  return (poses_[point.body] * Point<frame::Bone>{point.at}).v;
}

Vec3 ScriptedArthroscopist::in_portal(std::uint8_t portal, double beyond_capsule_mm) const {
  const HandPose at = hole(portal);
  return at.tip - at.shaft * (map_.portals[portal].capsule_mm + beyond_capsule_mm);
}

HandPose ScriptedArthroscopist::through(std::uint8_t portal, const Vec3& tip) const {
  const HandPose at = hole(portal);
  const double deep = -dot(tip - at.tip, at.shaft);
  return {tip, deep > 4.0 ? normalized_or(at.tip - tip, at.shaft) : at.shaft};
}

arthroscopy::OpenedSpace ScriptedArthroscopist::space_at(std::uint8_t joint, const Vec3& at) const {
  const cases::JointSpace& space = map_.joints[joint];
  return arthroscopy::opened_space_at(space.wall, poses_[space.proximal].inverse(),
                                      poses_[space.distal].inverse(), at);
}

/// Between the pulled bones, and not behind the joint's wall.
bool ScriptedArthroscopist::has_room(std::uint8_t joint, const Vec3& at, double room_mm) const {
  const arthroscopy::OpenedSpace wall = space_at(joint, at);
  if (!wall.is_near || wall.distance_mm > kBehindMm) return false;
  for (const auto& [bone, from_patient] : bones_) {
    const Vec3 local = (from_patient * Point<frame::Patient>{at}).v;
    const fields::DistanceSample s = fields::sample_distance(bone->distance_field, local);
    if (s.is_inside_grid && s.distance_mm < room_mm) return false;
  }
  return true;
}

/// Tip and shaft have room from the capsule on.
bool ScriptedArthroscopist::goes_in(const Vec3& tip, std::uint8_t portal, double radius_mm) const {
  const arthroscopy::OpenedSpace wall = space_at(map_.portals[portal].joint, tip);
  if (!wall.is_near || wall.distance_mm > 0.1) return false;
  const HandPose held = through(portal, tip);
  for (double s = 0; s < 12.0; s += 1.0) {
    const Vec3 at = tip + held.shaft * s;
    if (is_in_metal(at, radius_mm)) return false;
    for (const auto& [bone, from_patient] : bones_) {
      const Vec3 local = (from_patient * Point<frame::Patient>{at}).v;
      const fields::DistanceSample d = fields::sample_distance(bone->distance_field, local);
      if (d.is_inside_grid && d.distance_mm < radius_mm) return false;
    }
  }
  return true;
}

bool ScriptedArthroscopist::is_in_metal(const Vec3& at, double radius_mm) const {
  if (lesions_ == nullptr || !lesions_->screw) return false;
  const Vec3 local = (poses_[lesions_->screw->body].inverse() * Point<frame::Patient>{at}).v;
  return cases::in_screw(*lesions_->screw, local, radius_mm).depth_mm > 0;
}

bool ScriptedArthroscopist::is_free(std::uint8_t joint, const Vec3& from, const Vec3& to) const {
  const double far = distance(from, to);
  for (double s = 0.5; s < far - 0.8; s += 0.5) {
    if (!has_room(joint, from + (to - from) * (s / far), 0.0)) return false;
  }
  return true;
}

ScriptedArthroscopist::View ScriptedArthroscopist::view_of(std::uint8_t portal,
                                                           const Vec3& point,
                                                           const Vec3& from) const {
  return view_of(portal, {&point, 1}, from);
}

ScriptedArthroscopist::View ScriptedArthroscopist::view_of(std::uint8_t portal,
                                                           std::span<const Vec3> places,
                                                           const Vec3& from) const {
  const double half_field = arthroscopy::cos_sin_deg(lens_.field_deg / 2)[0];
  return view_of(portal, places, from, half_field + kInFieldCosine, kTurnStepDeg);
}

/// Tries tips about the capsule's hole and turns of the shaft.
ScriptedArthroscopist::View ScriptedArthroscopist::view_of(std::uint8_t portal,
                                                           std::span<const Vec3> places,
                                                           const Vec3& from,
                                                           double least_cosine,
                                                           double turn_step_deg) const {
  const std::uint8_t joint = map_.portals[portal].joint;
  const Vec3 inwards = -hole(portal).shaft;
  const double scope_radius =
      instruments::catalogue()[procedure_.tray.front()].shape.greatest_radius_mm();
  const Vec3 across = normalized_or(cross(inwards, map_.distal), {1, 0, 0});
  View best;
  double least = 1e9;
  for (double deep = 1.0; deep <= kDeepestMm; deep += 1.0) {
    for (double aside = -8.0; aside <= 8.0; aside += 1.0) {
      for (double up = -2.0; up <= 3.5; up += 0.5) {
        const Vec3 tip = in_portal(portal, deep) + across * aside + map_.distal * up;
        const HandPose held = through(portal, tip);
        const Vec3 eye = tip + held.shaft * scope_radius;
        const double way = 1.5 * distance(tip, from) + 0.5 * deep;
        if (way >= least) continue;
        const bool is_near = std::all_of(places.begin(), places.end(), [&](const Vec3& place) {
          const double far = distance(eye, place);
          return far >= 2.0 && far <= 13.0;
        });
        if (!is_near || !goes_in(tip, portal, scope_radius + kSpareMm)) continue;
        const bool are_seen = std::all_of(places.begin(), places.end(), [&](const Vec3& place) {
          return is_free(joint, eye, place);
        });
        if (!are_seen) continue;
        for (double turn = -180.0; turn < 180.0; turn += turn_step_deg) {
          const arthroscopy::Sight sight =
              arthroscopy::sight_of(lens_, {eye, held.shaft, turn, 0.0}, map_.distal);
          double cosine = 1.0;
          for (const Vec3& place : places) {
            cosine = std::min(cosine, dot(place - eye, sight.axis) / distance(place, eye));
          }
          if (cosine < least_cosine) continue;
          const double cost =
              way + 6.0 * (1.0 - cosine) / 0.1 + 0.01 * std::abs(wrapped(turn - planned_turn_deg_));
          if (cost >= least) continue;
          least = cost;
          best = {tip, turn, true};
        }
      }
    }
  }
  return best;
}

}  // namespace carpus::trainee
