// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/aim.hpp"

#include <vector>

#include "procedures/scaphoid_fixation/screws.hpp"

namespace carpus::procedures::scaphoid_fixation {

procedure::Aim aim_of(const cases::CaseData& data,
                      Approach approach,
                      std::span<const instruments::InstrumentIndex> tray) {
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
  aim.chord_mm = distance(near, far);
  const std::vector<instruments::InstrumentIndex> screws = screws_on(tray);
  if (const int ideal = ideal_screw(screws, aim.chord_mm); ideal >= 0) {
    aim.screw = screws[static_cast<std::size_t>(ideal)];
    // In the middle: as much bone over either end.
    aim.screw_tail_mm = (aim.chord_mm - instruments::catalogue()[aim.screw].length_mm) / 2;
  }
  return aim;
}

}  // namespace carpus::procedures::scaphoid_fixation
