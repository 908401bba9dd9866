// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/dorsal_scaphoid_fixation/declared.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/units.hpp"
#include "procedures/scaphoid_fixation/aim.hpp"
#include "procedures/scaphoid_fixation/predicates.hpp"

namespace carpus::procedures::dorsal_scaphoid_fixation {
namespace {

constexpr double kWaitingMm = 60.0;         // from beside the pole: out of the skin
constexpr double kBesidePoleMm = 10.0;      // towards ulnar, over the lunate [E]
constexpr double kDriverClearanceMm = 6.0;  // beside the axis: half a 12 mm drill guide [E]
constexpr double kFlexionStepDeg = 5.0;
constexpr double kGreatestFlexionDeg = 60.0;

double distance_to_ray(const Vec3& p, const Vec3& start, const Vec3& unit) {
  const Vec3 w = p - start;
  return length(w - unit * std::max(0.0, dot(w, unit)));
}

/// Smallest distance [mm] between radius and ulna, with the wrist held so, and the central axis
/// extended out of the proximal pole.
double clearance_mm(const cases::CaseData& data, const procedure::WristPose& wrist) {
  const cases::AxisSegment& axis = data.scaphoid.central_axis;
  const auto scaphoid = data.hand_motion.pose_of(BoneId::Scaphoid, wrist);
  const Vec3 start = (scaphoid * Point<frame::Bone>{axis.proximal}).v;
  const Vec3 outward =
      normalized_or((scaphoid * Direction<frame::Bone>{axis.proximal - axis.distal}).v, {0, 0, 1});
  double clearance = 1e30;
  for (const cases::Bone& bone : data.bones) {
    if (!belongs_to_forearm(bone.bone)) continue;
    const auto pose = data.hand_motion.pose_of(bone.bone, wrist);
    for (const Vec3& v : bone.surface.vertices) {
      clearance =
          std::min(clearance, distance_to_ray((pose * Point<frame::Bone>{v}).v, start, outward));
    }
  }
  return clearance;
}

/// Surgeons flex by about 45 degrees [clinical: S35, B1]: here the smallest flexion, from how the
/// hand was scanned, that leaves room for the driver; where none does, the one that leaves most.
procedure::WristPose flexed(const cases::CaseData& data) {
  procedure::WristPose best = data.hand_motion.scan;
  double best_clearance = -1;
  for (double more = 0; more <= kGreatestFlexionDeg; more += kFlexionStepDeg) {
    procedure::WristPose wrist = data.hand_motion.scan;
    wrist.flexion_rad += radians_from_degrees(more);
    wrist = data.hand_motion.limits.clamp(wrist);
    const double clearance = clearance_mm(data, wrist);
    if (clearance > best_clearance) {
      best = wrist;
      best_clearance = clearance;
    }
    if (clearance >= kDriverClearanceMm) break;
  }
  return best;
}

Direction<frame::Patient> in_patient(const cases::CaseData& data, const Vec3& wrist) {
  return data.wrist_from_patient.inverse() * Direction<frame::Wrist>{normalized_or(wrist, {})};
}

/// Halfway between dorsal and proximal, as a driver is brought to the back of the hand: by some 30
/// to 40 degrees not the line that is sought. To find that one is what is practised [E].
Vec3 from_the_back_of_the_hand(const cases::CaseData& data) {
  return in_patient(data, {1.0, 0.0, -1.0}).v;
}

Vec3 towards_ulnar(const cases::CaseData& data) {
  return in_patient(data, {0.0, data.side == Side::Left ? 1.0 : -1.0, 0.0}).v;
}

/// The wrist lies straight, as it is surveyed; to pose it is a step [clinical: B1]. The wire waits
/// over the back of the hand, neither at the entry nor on the line.
procedure::Opening opening(const cases::CaseData& data) {
  if (cases::scaphoid_parts(data).empty()) {
    throw InvalidInput("dorsal scaphoid fixation: the case has no scaphoid to operate on");
  }
  const cases::AxisSegment& axis = data.scaphoid.central_axis;
  procedure::Opening opening;
  opening.wrist = flexed(data);
  opening.at_first = procedure::WristPose{};
  opening.shaft_in_target = from_the_back_of_the_hand(data);
  opening.tip_in_target =
      axis.proximal + towards_ulnar(data) * kBesidePoleMm + opening.shaft_in_target * kWaitingMm;
  opening.aim =
      scaphoid_fixation::aim_of(data, scaphoid_fixation::Approach::FromProximal, declared().tray);
  return opening;
}

procedure::Procedure read() {
  constexpr auto kPredicates = scaphoid_fixation::named_predicates();
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
