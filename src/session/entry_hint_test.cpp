// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/entry_hint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/synthetic_case_test_support.hpp"
#include "core/units.hpp"

namespace carpus::session {
namespace {

const cases::CaseData& wrist() {
  static const cases::CaseData data = cases::test::synthetic_case();
  return data;
}

/// Patient of the synthetic wrist: proximal is +z, volar -y, ulnar -x; the aim goes in at the
/// origin and straight distally.
std::string hint(const Vec3& entry, const Vec3& line, double turned_deg = 0.0) {
  procedure::Aim aim;
  aim.body = 0;
  aim.direction = {0, 0, -1};
  simulation::Snapshot now;
  now.body_count = 1;
  // The bone may have turned with the hand: what is told is told in the hand.
  const double half = radians_from_degrees(turned_deg) / 2;
  now.patient_from_bone[0].rotation =
      rotation_from_quaternion(std::cos(half), std::sin(half), 0, 0);
  now.patient_from_bone[0].translation = {5, -3, 2};
  const auto& pose = now.patient_from_bone[0];
  simulation::ItemView item;
  item.entry_in_patient = (pose * Point<frame::Bone>{entry}).v;
  item.shaft_in_patient = (pose * Direction<frame::Bone>{-normalized_or(line, {})}).v;
  return entry_hint(wrist(), aim, now, item);
}

TEST(EntryHint, SaysWhatToChange) {
  EXPECT_EQ(hint({-4, 0, 0}, {0, 0, -1}), "Enter 4 mm more radial.");
  EXPECT_EQ(hint({0, 3, 6}, {0, 0, -1}), "Enter 3 mm more volar.") << "along the line is no error";
  const double angle = radians_from_degrees(18);
  EXPECT_EQ(hint({0, 0, 0}, {0, std::sin(angle), -std::cos(angle)}), "Aim 18° more volar.");
  EXPECT_EQ(hint({-4, 0, 0}, {std::sin(angle), 0, -std::cos(angle)}),
            "Enter 4 mm more radial. Aim 18° more ulnar.");
}

TEST(EntryHint, IsContentWithWhatIsNear) {
  EXPECT_EQ(hint({1, 1, 0}, {0.05, 0, -1}), "It lies where it should.");
}

TEST(EntryHint, DirectionsAreThoseOfTheHand) {
  EXPECT_EQ(hint({-4, 0, 0}, {0, 0, -1}, 60.0), "Enter 4 mm more radial.");
  EXPECT_EQ(hint({0, 3, 0}, {0, 0, -1}, 60.0), "Enter 3 mm more volar.");
}

}  // namespace
}  // namespace carpus::session
