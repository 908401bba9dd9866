// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/aim.hpp"

#include <vector>

#include "procedures/scaphoid_fixation/screws.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

/// The piece with that end of the bone; the bone, where it is whole; kNoBody where there is none.
std::uint8_t piece_of(const cases::CaseData& data, BonePart part) {
  std::uint8_t found = procedure::kNoBody;
  for (std::uint8_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone != BoneId::Scaphoid) continue;
    if (data.bones[b].part == part || data.bones[b].part == BonePart::Whole) return b;
    found = b;
  }
  return found;
}

/// Of the bone reduced, frame Bone of the piece with the entry; as scanned where nothing is to be
/// reduced.
cases::AxisSegment seen_from_piece(const cases::CaseData& data,
                                   Approach approach,
                                   const cases::AxisSegment& segment) {
  if (!data.reduced || approach == Approach::FromProximal) return segment;
  const auto back = data.reduced->proximal_from_distal.inverse();
  return {(back * Point<frame::Bone>{segment.proximal}).v,
          (back * Point<frame::Bone>{segment.distal}).v};
}

}  // namespace

procedure::Aim aim_of(const cases::CaseData& data,
                      Approach approach,
                      std::span<const instruments::InstrumentIndex> tray) {
  constexpr double kEntryWithinMm = 4.0;
  const bool from_proximal = approach == Approach::FromProximal;
  procedure::Aim aim;
  aim.body = piece_of(data, from_proximal ? BonePart::Proximal : BonePart::Distal);
  const cases::ScaphoidLandmarks& marks = data.reduced ? data.reduced->marks : data.scaphoid;
  const cases::AxisSegment axis = seen_from_piece(data, approach, marks.central_axis);
  const Vec3 near = from_proximal ? axis.proximal : axis.distal;
  const Vec3 far = from_proximal ? axis.distal : axis.proximal;
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
