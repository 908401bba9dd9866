// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/volar_scaphoid_fixation/declared.hpp"

#include "core/error.hpp"
#include "core/units.hpp"
#include "procedures/scaphoid_fixation/aim.hpp"
#include "procedures/scaphoid_fixation/predicates.hpp"

namespace carpus::procedures::volar_scaphoid_fixation {
namespace {

// Over a roll, in extension and ulnar deviation [clinical: K, B2]; by how much: [E], most of what
// the wrist allows without force.
constexpr double kExtensionDeg = 40.0;
constexpr double kUlnarDeviationDeg = 20.0;
constexpr double kWaitingMm = 60.0;  // from the tubercle: out of the skin

/// The blind start, 45 degrees dorsal and 45 degrees ulnar of the long axis, as a way back to the
/// hand: distal, volar and radial [clinical: S43, B2].
Vec3 away_from_bone(const cases::CaseData& data) {
  const double radial = data.side == Side::Left ? -1.0 : 1.0;  // frame::Wrist: +y ulnar on the left
  const Vec3 in_wrist = normalized_or({-1.0, radial, 1.0}, {});
  return (data.wrist_from_patient.inverse() * Direction<frame::Wrist>{in_wrist}).v;
}

procedure::Opening opening(const cases::CaseData& data) {
  if (cases::scaphoid_parts(data).empty()) {
    throw InvalidInput("volar scaphoid fixation: the case has no scaphoid to operate on");
  }
  procedure::Opening opening;
  opening.wrist.flexion_rad = -radians_from_degrees(kExtensionDeg);
  opening.wrist.radial_deviation_rad = -radians_from_degrees(kUlnarDeviationDeg);
  opening.shaft_in_target = away_from_bone(data);
  opening.tip_in_target = data.scaphoid.central_axis.distal + opening.shaft_in_target * kWaitingMm;
  opening.aim =
      scaphoid_fixation::aim_of(data, scaphoid_fixation::Approach::FromDistal, declared().tray);
  return opening;
}

procedure::Procedure read() {
  constexpr auto kPredicates = scaphoid_fixation::named_predicates();
  procedure::Procedure read =
      procedure::read_procedure(json(), "volar_scaphoid_fixation/procedure.json", kPredicates);
  read.opening = opening;
  read.score = score;
  return read;
}

}  // namespace

const procedure::Procedure& declared() {
  static const procedure::Procedure kDeclared = read();
  return kDeclared;
}

}  // namespace carpus::procedures::volar_scaphoid_fixation
