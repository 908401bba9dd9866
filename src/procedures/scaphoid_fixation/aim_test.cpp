// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/aim.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/reduced_scaphoid.hpp"
#include "cases/scaphoid_landmarks.hpp"
#include "cases/synthetic_case_test_support.hpp"
#include "procedures/built_in.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

std::span<const instruments::InstrumentIndex> tray() {
  return built_in().find("dorsal_scaphoid_fixation")->tray;
}

/// The synthetic wrist with its scaphoid in halves, the distal one moved so.
cases::CaseData broken(const Pose<frame::Bone, frame::Bone>& moved) {
  cases::CaseData data = cases::test::synthetic_case();
  const auto it = std::find_if(data.bones.begin(), data.bones.end(), [](const cases::Bone& bone) {
    return bone.bone == BoneId::Scaphoid;
  });
  cases::Bone distal = *it;
  it->part = BonePart::Proximal;
  it->surface = cases::test::half_scaphoid(BonePart::Proximal, 0.0);
  distal.part = BonePart::Distal;
  distal.surface = moved * cases::test::half_scaphoid(BonePart::Distal, 0.0);
  data.bones.insert(it + 1, std::move(distal));
  data.scaphoid = cases::find_scaphoid_landmarks(data);
  data.reduced = cases::find_reduced_scaphoid(data);
  return data;
}

/// Turned about the face's middle, then shifted.
Pose<frame::Bone, frame::Bone> displaced(double angle_rad, const Vec3& shift) {
  const Vec3 middle = cases::test::synthetic_scaphoid().centre;
  const Mat3 rotation = rotation_about({0.6, 0.8, 0}, angle_rad);
  return {rotation, middle + shift - rotation * middle};
}

void expect_axis(const procedure::Aim& aim, const Vec3& entry, const Vec3& direction) {
  EXPECT_LT(distance(aim.entry, entry), 0.6);
  EXPECT_GT(dot(aim.direction, direction), 0.998);
}

/// Whoever reduces the bone finds the line where it is in the whole bone.
TEST(Aim, OfABoneToBeReducedIsThatOfTheBoneReduced) {
  const cases::CaseData whole = cases::test::synthetic_case();
  const procedure::Aim wanted = aim_of(whole, Approach::FromProximal, tray());
  ASSERT_LT(wanted.body, whole.bones.size());
  EXPECT_EQ(whole.bones[wanted.body].bone, BoneId::Scaphoid);

  const auto pose = displaced(0.2, {2.0, -1.5, 1.0});
  const cases::CaseData data = broken(pose);
  const procedure::Aim dorsal = aim_of(data, Approach::FromProximal, tray());
  EXPECT_EQ(data.bones[dorsal.body].part, BonePart::Proximal);
  expect_axis(dorsal, wanted.entry, wanted.direction);
  EXPECT_NEAR(dorsal.chord_mm, wanted.chord_mm, 0.8);

  // From distal the wire goes into the piece that lies astray: the line goes with it.
  const procedure::Aim from_distal = aim_of(whole, Approach::FromDistal, tray());
  const procedure::Aim volar = aim_of(data, Approach::FromDistal, tray());
  EXPECT_EQ(data.bones[volar.body].part, BonePart::Distal);
  expect_axis(volar, (pose * Point<frame::Bone>{from_distal.entry}).v,
              (pose * Direction<frame::Bone>{from_distal.direction}).v);
}

TEST(Aim, OfPiecesThatMeetIsThatOfTheBoneAsScanned) {
  const cases::CaseData data = broken(displaced(0.0, {}));
  EXPECT_FALSE(data.reduced.has_value());
  const procedure::Aim aim = aim_of(data, Approach::FromProximal, tray());
  EXPECT_EQ(aim.entry, data.scaphoid.central_axis.proximal);
}

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
