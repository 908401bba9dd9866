// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "anatomy/bone_words.hpp"
#include "core/units.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

double angle_between_deg(const Vec3& a, const Vec3& b) {
  return degrees_from_radians(std::atan2(length(cross(a, b)), dot(a, b)));
}

Offset offset_at(const BoneSolid& scaphoid,
                 const Vec3& on_axis,
                 const Vec3& axis_direction,
                 const Vec3& entry,
                 const Vec3& direction) {
  Offset offset;
  const double along = dot(direction, axis_direction);
  if (std::abs(along) < 0.05) {  // across the bone: it meets this level nowhere near
    offset.distance_mm = length(cross(on_axis - entry, direction));
  } else {
    const double t = dot(on_axis - entry, axis_direction) / along;
    offset.distance_mm = distance(entry + direction * t, on_axis);
  }
  // Near the fracture a section may cut the gap's mouth: the widest of three levels stands for all.
  constexpr double kLevelMm = 0.8;
  double area = 0;
  for (const double level : {-kLevelMm, 0.0, kLevelMm}) {
    area =
        std::max(area, scaphoid.section_area_mm2(on_axis + axis_direction * level, axis_direction));
  }
  offset.local_width_mm = 2.0 * std::sqrt(area / std::numbers::pi);
  return offset;
}

/// Distance from a point outside to the outer surface [mm].
double distance_to_outside(const BoneSolid& scaphoid, const Vec3& p) {
  double best = 1e30;
  for (const OuterPoint& outer : scaphoid.outer_points()) {
    best = std::min(best, squared_length(outer.point - p));
  }
  return std::sqrt(best);
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

/// Deepest place of the screw's envelope outside the bone.
void find_penetration(const BoneSolid& scaphoid,
                      const cases::CaseData& data,
                      const LineInterval& chord,
                      Approach approach,
                      const procedure::LineFacts& lain,
                      ScrewPlacement& placement) {
  const instruments::Instrument& screw = instruments::catalogue()[lain.instrument];
  constexpr double kStepMm = 0.5;
  constexpr int kAround = 16;
  constexpr double kResolutionMm = 0.3;  // of the voxelised solid: less is not told from contact
  const Vec3 a = any_perpendicular(lain.direction_in_bone);
  const Vec3 b = cross(lain.direction_in_bone, a);
  const double tip = lain.depth_mm;
  const double tail = tip - screw.length_mm;
  Vec3 worst;
  double worst_t = 0;
  const auto consider = [&](double t, const Vec3& p) {
    if (scaphoid.contains(p)) return;
    const double out = distance_to_outside(scaphoid, p);
    if (out <= placement.penetration_mm || out <= kResolutionMm) return;
    placement.penetration_mm = out;
    worst = p;
    worst_t = t;
  };
  const int steps = static_cast<int>(std::ceil(screw.length_mm / kStepMm));
  for (int i = 0; i <= steps; ++i) {
    const double t = tail + screw.length_mm * i / steps;
    const Vec3 centre = lain.entry_in_bone + lain.direction_in_bone * t;
    consider(t, centre);
    // The ends are rounded: their rim is not counted, only their middle.
    if (i == 0 || i == steps) continue;
    const double share = static_cast<double>(i) / steps;
    const double radius =
        0.5 * (screw.tail_diameter_mm + (screw.tip_diameter_mm - screw.tail_diameter_mm) * share);
    for (int j = 0; j < kAround; ++j) {
      const double angle = 2 * std::numbers::pi * j / kAround;
      consider(t, centre + (a * std::cos(angle) + b * std::sin(angle)) * radius);
    }
  }
  if (placement.penetration_mm > 0) {
    placement.penetration_at = place_in_words(data, chord, approach, worst_t, worst);
  }
}

}  // namespace

std::optional<LinePlacement> place_line(const BoneSolid& scaphoid,
                                        const cases::ScaphoidLandmarks& landmarks,
                                        Approach approach,
                                        const Vec3& entry,
                                        const Vec3& direction) {
  const cases::AxisSegment& axis = landmarks.central_axis;
  const Vec3 along = axis.distal - axis.proximal;
  const double sign =
      approach == Approach::FromProximal ? 1.0 : -1.0;  // the way that the wire goes
  const Vec3 axis_direction = normalized_or(along, {0, 0, 1}) * sign;
  constexpr double kInsideMm = 1.0;  // the entry itself may lie a hair outside
  const auto chord = scaphoid.chord_through(entry + direction * kInsideMm, direction);
  if (!chord) return std::nullopt;
  LinePlacement line;
  line.chord = {chord->enter_mm + kInsideMm, chord->leave_mm + kInsideMm};
  line.angle_deg = angle_between_deg(direction, axis_direction);
  line.angle_to_longest_deg = angle_between_deg(
      direction, (landmarks.longest_line.distal - landmarks.longest_line.proximal) * sign);
  const auto level = [&](const Vec3& p) {
    return offset_at(scaphoid, p, axis_direction, entry, direction);
  };
  line.at_waist = level(landmarks.waist);
  line.at_proximal = level(axis.proximal + along / 6.0);
  line.at_distal = level(axis.distal - along / 6.0);
  return line;
}

ScrewPlacement place_screw(const BoneSolid& scaphoid,
                           const cases::CaseData& data,
                           const LinePlacement& line,
                           Approach approach,
                           const procedure::LineFacts& lain) {
  ScrewPlacement placement;
  const double length_mm = instruments::catalogue()[lain.instrument].length_mm;
  placement.tail_cover_mm = lain.depth_mm - length_mm - line.chord.enter_mm;
  placement.tip_cover_mm = line.chord.leave_mm - lain.depth_mm;
  find_penetration(scaphoid, data, line.chord, approach, lain, placement);
  return placement;
}

}  // namespace carpus::procedures::scaphoid_fixation
