// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/score_message.hpp"

#include "session/snapshot_message.hpp"

namespace carpus::session {

namespace {

/// Of the report's form; it changes when a key changes its meaning.
constexpr std::int64_t kScoreVersion = 2;

// The enumeration of protocol.json is in the order of the procedure's.
static_assert(static_cast<int>(protocol::Grade::NotMeasured) ==
              static_cast<int>(procedure::Grade::NotMeasured));
static_assert(static_cast<int>(protocol::RightAnswer::Decline) ==
              static_cast<int>(cases::RightAnswer::Decline));

static_assert(static_cast<int>(protocol::Scuffing::Shaved) ==
              static_cast<int>(procedure::Scuffing::Shaved));

protocol::Placement placement_message(const procedure::PlacementPicture& picture) {
  protocol::Placement placement;
  placement.central_axis = {picture.central_axis.from, picture.central_axis.to};
  placement.waist_mm = picture.waist;
  if (picture.wire) placement.wire = protocol::PlacedWire{picture.wire->from, picture.wire->to};
  if (picture.screw) {
    placement.screw =
        protocol::PlacedScrew{picture.screw->from, picture.screw->to, picture.screw_tip_diameter_mm,
                              picture.screw_tail_diameter_mm};
  }
  for (const procedure::PlacedPiece& piece : picture.pieces) {
    if (!placement.pieces) placement.pieces.emplace();
    placement.pieces->push_back({std::string(name_of(piece.bone, piece.part)),
                                 {quaternion_of(piece.pose.rotation), piece.pose.translation}});
  }
  return placement;
}

protocol::ScoreItem item_message(const procedure::ScoreItem& item) {
  return {item.id,     item.label,           item.value,
          item.unit,   item.target,          static_cast<protocol::Grade>(item.grade),
          item.points, item.points_possible, item.reason,
          item.mark};
}

protocol::ScuffedPlace scuff_message(const procedure::ScuffedPlace& place) {
  protocol::ScuffedPlace told;
  told.bone = name_of(place.bone, place.part);
  told.at_mm = place.scuff.at;
  told.tick = static_cast<std::int64_t>(place.scuff.tick);
  told.how = static_cast<protocol::Scuffing>(place.scuff.how);
  told.force_n = place.scuff.force_n;
  told.instrument = place.instrument;
  return told;
}

}  // namespace

protocol::ScoreReport score_message(const procedure::ScoreReport& report) {
  protocol::ScoreReport message;
  message.score_version = kScoreVersion;
  message.overall = report.overall;
  message.fixation_acceptable = report.is_fixation_acceptable;
  if (report.is_void) message.is_void = true;
  if (!report.declined_for.empty()) message.declined_for = report.declined_for;
  if (report.answer) {
    message.answer = protocol::CaseAnswer{
        report.answer->title, static_cast<protocol::RightAnswer>(report.answer->right_answer),
        report.answer->reason};
  }
  for (const procedure::MustHave& must : report.must_haves) {
    protocol::MustHave& told = message.must_haves.emplace_back();
    told.id = must.id;
    told.label = must.label;
    told.fulfilled = must.fulfilled;
    if (must.not_measured) told.not_measured = true;
  }
  for (const procedure::ScoreItem& item : report.items) {
    message.items.push_back(item_message(item));
  }
  message.central_axis_length_mm = report.central_axis_length_mm;
  message.central_cylinder_radius_mm = report.central_cylinder_radius_mm;
  message.longest_line_mm = report.longest_line_mm;
  message.angle_to_longest_line_deg = report.angle_to_longest_line_deg;
  message.true_length_mm = report.true_length_mm;
  message.gauge_reading_mm = report.gauge_reading_mm;
  message.ideal_screw_index = report.ideal_screw_index;
  message.ideal_screw = report.ideal_screw;
  message.chosen_screw_index = report.chosen_screw_index;
  message.chosen_screw = report.chosen_screw;
  message.penetration_at = report.penetration_at;
  message.placement = placement_message(report.placement);
  for (const procedure::ScuffedPlace& place : report.scuffs) {
    if (!message.scuffs) message.scuffs.emplace();
    message.scuffs->push_back(scuff_message(place));
  }
  return message;
}

}  // namespace carpus::session
