// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/reduction_hint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/synthetic_case_test_support.hpp"
#include "core/units.hpp"

namespace carpus::session {
namespace {

/// Patient of the synthetic wrist: proximal is +z, volar -y, ulnar -x. The first piece's face looks
/// distally, the second's proximally.
const cases::CaseData& wrist() {
  static const cases::CaseData data = [] {
    cases::CaseData made = cases::test::synthetic_case();
    made.bones[0].bone = made.bones[1].bone = BoneId::Scaphoid;
    made.bones[0].part = BonePart::Proximal;
    made.bones[1].part = BonePart::Distal;
    return made;
  }();
  return data;
}

/// The second piece shifted and turned about x, both carried along by the hand.
std::string hint(const Vec3& shift, double turned_deg = 0.0, double hand_deg = 0.0) {
  const BrokenBone broken{0, 1, {{0, 0, 0}, {0, 0, -1}, {0, 0, 0}, {0, 0, 1}}};
  const auto about_x = [](double deg) {
    const double half = radians_from_degrees(deg) / 2;
    return rotation_from_quaternion(std::cos(half), std::sin(half), 0, 0);
  };
  simulation::Snapshot now;
  now.body_count = 2;
  const Pose<frame::Patient, frame::Bone> hand{about_x(hand_deg), {5, -3, 2}};
  now.patient_from_bone[0] = hand;
  now.patient_from_bone[1] = hand * Pose<frame::Bone, frame::Bone>{about_x(turned_deg), shift};
  return reduction_hint(wrist(), broken, now);
}

TEST(ReductionHint, SaysWhereToLeadAndHowToTurn) {
  EXPECT_EQ(hint({2, 0, 0}), "Lead the distal part of the scaphoid 2 mm ulnar.")
      << "it lies radially";
  EXPECT_EQ(hint({0, -3, 0}), "Lead the distal part of the scaphoid 3 mm dorsal.");
  EXPECT_EQ(hint({0, 0, 0}, 15),
            "Turn the distal part of the scaphoid until its fracture face looks 15° more dorsal.");
  EXPECT_EQ(hint({0, 0, -2}, -12),
            "Lead the distal part of the scaphoid 2 mm proximal; turn it until its fracture face "
            "looks 12° more volar.");
}

TEST(ReductionHint, DirectionsAreThoseOfTheHand) {
  EXPECT_EQ(hint({2, 0, 0}, 0, 60), "Lead the distal part of the scaphoid 2 mm ulnar.");
}

TEST(ReductionHint, IsContentWithWhatMeets) {
  EXPECT_EQ(hint({0.4, 0.3, -0.5}, 4), "The pieces meet.");
}

TEST(ReductionHint, AWholeBoneHasNone) {
  EXPECT_FALSE(broken_bone_of(cases::test::synthetic_case(), BoneId::Scaphoid).has_value());
}

}  // namespace
}  // namespace carpus::session
