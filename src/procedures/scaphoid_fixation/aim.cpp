// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/aim.hpp"

namespace carpus::procedures::scaphoid_fixation {

procedure::Aim aim_of(const cases::CaseData& data, Approach approach) {
  constexpr double kEntryWithinMm = 4.0;
  const cases::ScaphoidLandmarks& marks = data.scaphoid;
  const bool from_proximal = approach == Approach::FromProximal;
  const Vec3 near = from_proximal ? marks.central_axis.proximal : marks.central_axis.distal;
  const Vec3 far = from_proximal ? marks.central_axis.distal : marks.central_axis.proximal;
  procedure::Aim aim;
  aim.entry = near;
  aim.direction = normalized_or(far - near, {0, 0, 1});
  aim.length_mm = distance(marks.longest_line.proximal, marks.longest_line.distal);
  aim.entry_within_mm = kEntryWithinMm;
  return aim;
}

}  // namespace carpus::procedures::scaphoid_fixation
