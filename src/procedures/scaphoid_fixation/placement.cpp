// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "anatomy/bone_words.hpp"
#include "cases/direction_words.hpp"
#include "core/units.hpp"
#include "procedures/scaphoid_fixation/screw_envelope.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

double angle_between_deg(const Vec3& a, const Vec3& b) {
  return degrees_from_radians(std::atan2(length(cross(a, b)), dot(a, b)));
}

Offset offset_at(const BoneSolid& scaphoid,
                 const cases::CaseData& data,
                 const Vec3& on_axis,
                 const Vec3& axis_direction,
                 const Vec3& entry,
                 const Vec3& direction) {
  // Near a gap a section may cut its mouth: of three levels the widest counts.
  constexpr double kLevelMm = 0.8;
  constexpr double kAcross = 0.05;  // a line so flat meets this level nowhere near
  Offset offset;
  double area = -1.0;
  for (const double level : {0.0, -kLevelMm, kLevelMm}) {
    const Vec3 point = on_axis + axis_direction * level;
    const BoneSection section = scaphoid.section_at(point, axis_direction);
    if (!(section.area_mm2 > area) || (level != 0.0 && scaphoid.is_whole())) continue;
    area = section.area_mm2;
    const Vec3 middle = section.area_mm2 > 0.0 ? section.centroid : point;
    const double along = dot(direction, axis_direction);
    const double t = std::abs(along) < kAcross ? dot(middle - entry, direction)
                                               : dot(middle - entry, axis_direction) / along;
    const Vec3 away = entry + direction * t - middle;
    offset.distance_mm = length(away);
    offset.local_width_mm = 2.0 * std::sqrt(section.area_mm2 / kPi);
    offset.towards = cases::direction_in_words(data, away);
  }
  return offset;
}

/// Name of the bone other than the scaphoid nearest to `p`, empty beyond 3 mm.
std::string_view neighbour_at(const cases::CaseData& data, const Vec3& p) {
  constexpr double kReachMm = 3.0;
  double best = kReachMm * kReachMm;
  std::string_view name;
  for (const cases::Bone& bone : data.bones) {
    if (bone.bone == BoneId::Scaphoid) continue;
    const Vec3 local = (bone.patient_from_bone.inverse() * Point<frame::Patient>{p}).v;
    for (const Vec3& v : bone.surface.vertices) {
      if (squared_length(v - local) < best) {
        best = squared_length(v - local);
        name = carpus::words_of(bone.bone, bone.part);
      }
    }
  }
  return name;
}

std::string place_in_words(const cases::CaseData& data,
                           const LineInterval& chord,
                           Approach approach,
                           double t,
                           const Vec3& p) {
  constexpr double kEndMm = 3.0;
  std::string words = "side";
  const bool is_proximal_first = approach == Approach::FromProximal;
  if (t < chord.enter_mm + kEndMm) words = is_proximal_first ? "proximal" : "distal";
  if (t > chord.leave_mm - kEndMm) words = is_proximal_first ? "distal" : "proximal";
  if (const std::string_view bone = neighbour_at(data, p); !bone.empty()) {
    words += ", towards the ";
    words += bone;
  }
  return words;
}

/// Of the line's part between tail and tip, in the fragment that has less of it; all of it in a
/// bone that is whole.
double length_in_smaller_part(const std::vector<MeshIn<frame::Bone>>& pieces,
                              const ScrewEnvelope& screw) {
  const double whole_mm = distance(screw.tail, screw.tip);
  double least = whole_mm;
  if (pieces.size() < 2) return least;
  const Vec3 direction = normalized_or(screw.tip - screw.tail, {0, 0, 1});
  for (const MeshIn<frame::Bone>& piece : pieces) {
    const std::array<const MeshIn<frame::Bone>*, 1> alone{&piece};
    double inside = 0.0;
    for (const LineInterval& interval : BoneSolid(alone).intervals_along(screw.tail, direction)) {
      inside +=
          std::max(0.0, std::min(whole_mm, interval.leave_mm) - std::max(0.0, interval.enter_mm));
    }
    least = std::min(least, inside);
  }
  return least;
}

}  // namespace

LyingBone lying_bone(std::vector<MeshIn<frame::Bone>> pieces,
                     const cases::ScaphoidLandmarks& marks) {
  std::vector<const MeshIn<frame::Bone>*> all;
  for (const MeshIn<frame::Bone>& piece : pieces) all.push_back(&piece);
  OuterBone bone(all);
  return {std::move(pieces), std::move(bone), marks};
}

std::optional<LinePlacement> place_line(const LyingBone& scaphoid,
                                        const cases::CaseData& data,
                                        Approach approach,
                                        const Vec3& entry,
                                        const Vec3& direction) {
  const cases::ScaphoidLandmarks& landmarks = scaphoid.marks;
  const cases::AxisSegment& axis = landmarks.central_axis;
  const Vec3 along = axis.distal - axis.proximal;
  const double sign =
      approach == Approach::FromProximal ? 1.0 : -1.0;  // the way that the wire goes
  const Vec3 axis_direction = normalized_or(along, {0, 0, 1}) * sign;
  constexpr double kInsideMm = 1.0;  // the entry itself may lie a hair outside
  const BoneSolid& solid = scaphoid.bone.solid();
  const auto chord = solid.chord_through(entry + direction * kInsideMm, direction);
  if (!chord) return std::nullopt;
  LinePlacement line;
  line.chord = {chord->enter_mm + kInsideMm, chord->leave_mm + kInsideMm};
  line.angle_deg = angle_between_deg(direction, axis_direction);
  line.angle_to_longest_deg = angle_between_deg(
      direction, (landmarks.longest_line.distal - landmarks.longest_line.proximal) * sign);
  const auto level = [&](const Vec3& p) {
    return offset_at(solid, data, p, axis_direction, entry, direction);
  };
  line.at_waist = level(landmarks.waist);
  line.at_proximal = level(axis.proximal + along / 6.0);
  line.at_distal = level(axis.distal - along / 6.0);
  line.leaves_towards = neighbour_at(data, entry + direction * line.chord.leave_mm);
  return line;
}

ScrewPlacement place_screw(const LyingBone& scaphoid,
                           const cases::CaseData& data,
                           const LinePlacement& line,
                           Approach approach,
                           const procedure::LineFacts& lain) {
  constexpr double kEndsMm = 4.0;  // of a screw, where every line nears the surface [E]
  const ScrewEnvelope screw = envelope_of(lain);
  const double length_mm = distance(screw.tail, screw.tip);
  ScrewPlacement placement;
  placement.tail_cover_mm = lain.depth_mm - length_mm - line.chord.enter_mm;
  placement.tip_cover_mm = line.chord.leave_mm - lain.depth_mm;
  const DeepestPlace worst = farthest_outside(scaphoid.bone, screw);
  placement.penetration_mm = worst.outside_mm;
  if (worst.outside_mm > 0) {
    placement.penetration_at = place_in_words(
        data, line.chord, approach, lain.depth_mm - length_mm * (1.0 - worst.along), worst.point);
  }
  placement.beside_mm = least_bone_beside(scaphoid.bone, screw, kEndsMm);
  placement.in_smaller_part_mm = length_in_smaller_part(scaphoid.pieces, screw);
  return placement;
}

}  // namespace carpus::procedures::scaphoid_fixation
