// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/facts.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "cases/scaphoid_landmarks.hpp"
#include "procedures/scaphoid_fixation/screws.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

using instruments::Instrument;
using instruments::Work;
using procedure::LineFacts;
using procedure::ScoreReport;

const Instrument& instrument_of(const LineFacts& line) {
  return instruments::catalogue()[line.instrument];
}

bool fits_a_screw(const Instrument& wire, const std::vector<instruments::InstrumentIndex>& screws) {
  return std::any_of(screws.begin(), screws.end(), [&](instruments::InstrumentIndex screw) {
    return wire.cut_tip_radius_mm <= instruments::catalogue()[screw].bore_radius_mm;
  });
}

void find_lines(Facts& facts) {
  for (const LineFacts& line : facts.record.lines) {
    if (!line.in_target || line.instrument >= instruments::catalogue().size()) continue;
    const Instrument& instrument = instrument_of(line);
    if (instrument.work == Work::Drill && fits_a_screw(instrument, facts.screws)) facts.wire = line;
    if (instrument.work == Work::Thread && line.depth_mm > 0) facts.screw = line;
  }
}

void find_passes(Facts& facts) {
  const auto& bones = facts.data.bones;
  std::vector<bool> is_entered(256, false);
  for (const procedure::Pass& pass : facts.record.passes) {
    if (pass.instrument >= instruments::catalogue().size()) continue;
    if (instruments::catalogue()[pass.instrument].work == Work::Drill) ++facts.wire_passes;
    for (std::size_t body = 0; body < bones.size() && body < 32; ++body) {
      if ((pass.bodies_entered >> body & 1U) == 0) continue;
      is_entered[static_cast<std::size_t>(bones[body].bone)] = true;
    }
  }
  for (const BoneId bone : kAllBones) {
    if (bone != facts.fixation.procedure->target && is_entered[static_cast<std::size_t>(bone)]) {
      facts.entered.push_back(bone);
    }
  }
}

void fill_references(ScoreReport& report, const Facts& facts) {
  const cases::ScaphoidLandmarks& marks = facts.marks;
  report.central_axis_length_mm = distance(marks.central_axis.proximal, marks.central_axis.distal);
  report.central_cylinder_radius_mm = marks.central_radius_mm;
  report.longest_line_mm = distance(marks.longest_line.proximal, marks.longest_line.distal);
  if (facts.record.gauge_reading_mm >= 0) report.gauge_reading_mm = facts.record.gauge_reading_mm;
  if (facts.line) {
    report.angle_to_longest_line_deg = facts.line->angle_to_longest_deg;
    report.true_length_mm = facts.line->length_mm();
    report.ideal_screw_index = ideal_screw_of(facts);
  }
  const auto catalogue = instruments::catalogue();
  if (report.ideal_screw_index >= 0) {
    report.ideal_screw =
        catalogue[facts.screws[static_cast<std::size_t>(report.ideal_screw_index)]].name;
  }
  if (facts.placed) {
    const auto found = std::find(facts.screws.begin(), facts.screws.end(), facts.screw->instrument);
    if (found != facts.screws.end()) {
      report.chosen_screw_index = static_cast<int>(found - facts.screws.begin());
    }
    report.chosen_screw = instrument_of(*facts.screw).name;
    report.penetration_at = facts.placed->penetration_at;
  }
}

/// Those that do not lie as scanned, seen from `body`.
std::vector<procedure::PlacedPiece> moved_pieces(const Facts& facts, std::size_t body) {
  std::vector<procedure::PlacedPiece> pieces;
  const auto& moved = facts.record.displacements;
  if (moved.size() != facts.data.bones.size() || body >= moved.size()) return pieces;
  for (std::size_t b = 0; b < moved.size(); ++b) {
    const cases::Bone& bone = facts.data.bones[b];
    const auto pose = moved[body].inverse() * moved[b];
    if (bone.bone != BoneId::Scaphoid || b == body) continue;
    if (pose == Pose<frame::Bone, frame::Bone>{}) continue;
    pieces.push_back({bone.bone, bone.part, pose});
  }
  return pieces;
}

procedure::PlacementPicture picture_of(const Facts& facts) {
  const cases::ScaphoidLandmarks& marks = facts.marks;
  procedure::PlacementPicture picture;
  picture.central_axis = {marks.central_axis.proximal, marks.central_axis.distal};
  picture.waist = marks.waist;
  if (const auto& line = fixed_line(facts)) picture.pieces = moved_pieces(facts, line->body);
  const auto at = [](const LineFacts& line, double depth_mm) {
    return line.entry_in_bone + line.direction_in_bone * depth_mm;
  };
  if (facts.wire) {
    picture.wire =
        procedure::PlacedLine{facts.wire->entry_in_bone, at(*facts.wire, facts.wire->depth_mm)};
  }
  if (!facts.placed) return picture;
  const LineFacts& lain = *facts.screw;
  const Instrument& screw = instrument_of(lain);
  picture.screw =
      procedure::PlacedLine{at(lain, lain.depth_mm - screw.length_mm), at(lain, lain.depth_mm)};
  picture.screw_tip_diameter_mm = screw.tip_diameter_mm;
  picture.screw_tail_diameter_mm = screw.tail_diameter_mm;
  return picture;
}

/// The fragments as they lie at the end, in the frame of the one in which the line is fixed.
std::vector<MeshIn<frame::Bone>> fragments_seen_from(const cases::CaseData& data,
                                                     const procedure::OperationRecord& record,
                                                     std::size_t body) {
  std::vector<MeshIn<frame::Bone>> fragments;
  const auto& moved = record.displacements;
  const bool has_moved = moved.size() == data.bones.size() && body < moved.size();
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone != BoneId::Scaphoid) continue;
    const MeshIn<frame::Bone>& surface = data.bones[b].surface;
    fragments.push_back(has_moved ? moved[body].inverse() * moved[b] * surface : surface);
  }
  return fragments;
}

/// Of the pieces as they lie. A piece that was led or drawn makes another bone: what the line is
/// measured against is found anew.
cases::ScaphoidLandmarks marks_of(const cases::CaseData& data,
                                  const procedure::OperationRecord& record,
                                  std::size_t body,
                                  const std::vector<MeshIn<frame::Bone>>& pieces) {
  constexpr double kMovedMm = 0.3;  // less changes no landmark by more than a mesh's facet
  double most = 0.0;
  std::size_t piece = 0;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone != BoneId::Scaphoid) continue;
    const auto& scanned = data.bones[b].surface.vertices;
    const auto& lying = pieces[piece++].vertices;
    for (std::size_t v = 0; v < scanned.size(); ++v) {
      most = std::max(most, squared_length(lying[v] - scanned[v]));
    }
  }
  if (!(most > kMovedMm * kMovedMm)) return data.scaphoid;
  std::vector<const MeshIn<frame::Bone>*> all;
  for (const MeshIn<frame::Bone>& each : pieces) all.push_back(&each);
  const Vec3 proximal = (record.displacements[body].inverse() *
                         Direction<frame::Bone>{data.scaphoid.central_axis.proximal -
                                                data.scaphoid.central_axis.distal})
                            .v;
  return cases::find_scaphoid_landmarks(all, proximal).value_or(data.scaphoid);
}

}  // namespace

const std::optional<LineFacts>& fixed_line(const Facts& facts) noexcept {
  return facts.screw ? facts.screw : facts.wire;
}

Facts facts_of(const cases::CaseData& data,
               const procedure::OperationRecord& record,
               const Fixation& fixation) {
  Facts facts{data, record, fixation, screws_on(fixation.procedure->tray), {}, {}, {}, {},
              {},   0,      {}};
  facts.marks = data.scaphoid;
  find_lines(facts);
  find_passes(facts);
  if (const auto& lain = fixed_line(facts)) {
    std::vector<MeshIn<frame::Bone>> lie = fragments_seen_from(data, record, lain->body);
    facts.marks = marks_of(data, record, lain->body, lie);
    const LyingBone scaphoid = lying_bone(std::move(lie), facts.marks);
    facts.line =
        place_line(scaphoid, data, fixation.approach, lain->entry_in_bone, lain->direction_in_bone);
    if (facts.line && facts.screw) {
      facts.placed = place_screw(scaphoid, data, *facts.line, fixation.approach, *facts.screw);
    }
  }
  return facts;
}

int ideal_screw_of(const Facts& facts) {
  return facts.line ? ideal_screw(facts.screws, facts.line->length_mm()) : -1;
}

ScoreReport references_of(const Facts& facts) {
  ScoreReport report;
  fill_references(report, facts);
  report.placement = picture_of(facts);
  return report;
}

}  // namespace carpus::procedures::scaphoid_fixation
