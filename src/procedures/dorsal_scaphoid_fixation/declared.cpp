// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"

#include "cases/posture.hpp"
#include "core/error.hpp"
#include "procedures/scaphoid_fixation/predicates.hpp"

namespace carpus::procedures::dorsal_scaphoid_fixation {
namespace {

constexpr double kWaitingMm = 60.0;  // from the pole: out of the skin

/// The wrist flexed until the central axis, extended out of the proximal pole, clears the radius;
/// the wire waits on that line.
procedure::Opening opening(const cases::CaseData& data) {
  if (cases::scaphoid_parts(data).empty()) {
    throw InvalidInput("dorsal scaphoid fixation: the case has no scaphoid to operate on");
  }
  const cases::Posture posture = data.operative_posture.flexion_from_scan_rad != 0
                                     ? data.operative_posture
                                     : cases::choose_operative_posture(data);
  const cases::AxisSegment& axis = data.scaphoid.central_axis;
  const Vec3 outward = normalized_or(axis.proximal - axis.distal, {0, 0, 1});
  procedure::Opening opening;
  opening.wrist.flexion_rad = posture.flexion_from_scan_rad;
  opening.tip_in_target = axis.proximal + outward * kWaitingMm;
  opening.shaft_in_target = outward;
  return opening;
}

procedure::Procedure read() {
  constexpr auto kPredicates = scaphoid_fixation::named_predicates<kDriveStep, kInsertStep>();
  procedure::Procedure read =
      procedure::read_procedure(json(), "dorsal_scaphoid_fixation/procedure.json", kPredicates);
  read.opening = opening;
  read.score = score;
  return read;
}

}  // namespace

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = read();
  return kDeclared;
}

}  // namespace carpus::procedures::dorsal_scaphoid_fixation
