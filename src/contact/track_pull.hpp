// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Why a second pass is drawn into the first one's track: a cutting tip gives way to the side where
// bone is gone. An engineering model; no published figure was found.
#pragma once

#include "fields/cut_field.hpp"
#include "geometry/pose.hpp"

namespace carpus::contact {

struct TrackPull {
  /// Unit, square to the axis, to where bone is missing; zero where strength is.
  Direction<frame::Bone> direction{};
  /// 0: as much bone on all sides; 1: none on one half of the ring, all on the other.
  double strength = 0;
};

/// Compares what was removed at eight places of a ring about the tip, one tool radius out: the tip
/// of a tool that cuts its own way has not opened its hole so far out, so the tool does not pull on
/// itself. Exactly zero in bone that is untouched, or missing alike, on opposite sides.
/// @param tip  foremost point of the tool.
/// @param shaft  unit, from the tip towards the hand.
/// @param radius_mm  of the tool, greater than 0.
/// Real-time: no allocation, only + - * / and sqrt.
[[nodiscard]] TrackPull track_pull(const fields::CutField& cut,
                                   const Point<frame::Bone>& tip,
                                   const Direction<frame::Bone>& shaft,
                                   double radius_mm) noexcept;

/// How far the pull moves the tip sideways at full strength [mm for each mm of way]: about half the
/// slope of a 1.14 mm trocar's point. Engineering value.
inline constexpr double kPullPerMm = 0.2;

}  // namespace carpus::contact
