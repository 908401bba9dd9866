// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/aim.hpp"

#include <array>
#include <optional>
#include <vector>

#include "anatomy/reduction.hpp"
#include "cases/scaphoid_landmarks.hpp"
#include "procedures/scaphoid_fixation/predicates.hpp"
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

/// Of a bone whose pieces lie apart: as they lie once their faces meet, frame Bone of `near`.
std::optional<cases::ScaphoidLandmarks> reduced(const cases::CaseData& data,
                                                const cases::Bone& near,
                                                const cases::Bone& far) {
  const auto faces = anatomy::reduction_of(near.surface, far.surface);
  if (!faces) return std::nullopt;
  if (!lies_apart(procedure::facts_of(faces->offset({})))) return std::nullopt;
  const MeshIn<frame::Bone> led = faces->first_from_second_reduced() * far.surface;
  const std::array<const MeshIn<frame::Bone>*, 2> pieces{&near.surface, &led};
  const cases::AxisSegment& scanned = data.scaphoid.central_axis;
  return cases::find_scaphoid_landmarks(pieces, scanned.proximal - scanned.distal);
}

}  // namespace

procedure::Aim aim_of(const cases::CaseData& data,
                      Approach approach,
                      std::span<const instruments::InstrumentIndex> tray) {
  constexpr double kEntryWithinMm = 4.0;
  const bool from_proximal = approach == Approach::FromProximal;
  procedure::Aim aim;
  aim.body = piece_of(data, from_proximal ? BonePart::Proximal : BonePart::Distal);
  const std::uint8_t far_piece =
      piece_of(data, from_proximal ? BonePart::Distal : BonePart::Proximal);
  cases::ScaphoidLandmarks marks = data.scaphoid;
  if (aim.body != far_piece) {
    marks = reduced(data, data.bones[aim.body], data.bones[far_piece]).value_or(marks);
  }
  const Vec3 near = from_proximal ? marks.central_axis.proximal : marks.central_axis.distal;
  const Vec3 far = from_proximal ? marks.central_axis.distal : marks.central_axis.proximal;
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
