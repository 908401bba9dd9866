// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/pose.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

namespace carpus {
namespace {

using WristFromPatient = Pose<frame::Wrist, frame::Patient>;

Vec3 arbitrary_vector() {
  const auto coordinate = [] { return *rc::gen::inRange(-1000, 1000) * 0.1; };
  return {coordinate(), coordinate(), coordinate()};
}

WristFromPatient arbitrary_pose() {
  const Vec3 axis = normalized_or(arbitrary_vector(), {0, 0, 1});
  return {rotation_about(axis, *rc::gen::inRange(-314, 314) * 0.01), arbitrary_vector()};
}

RC_GTEST_PROP(Pose, InverseUndoesIt, ()) {
  const WristFromPatient wrist_from_patient = arbitrary_pose();
  const Point<frame::Patient> p{arbitrary_vector()};
  RC_ASSERT(distance((wrist_from_patient.inverse() * (wrist_from_patient * p)).v, p.v) < 1e-10);
}

RC_GTEST_PROP(Pose, CompositionIsApplicationInTurn, ()) {
  const WristFromPatient wrist_from_patient = arbitrary_pose();
  const WristFromPatient other = arbitrary_pose();
  const Pose<frame::Patient, frame::Wrist> back = other.inverse();
  const Point<frame::Patient> p{arbitrary_vector()};
  RC_ASSERT(distance(((back * wrist_from_patient) * p).v, (back * (wrist_from_patient * p)).v) <
            1e-9);
}

TEST(Pose, QuarterTurnAboutZTakesXToY) {
  const Mat3 r = rotation_about({0, 0, 1}, std::numbers::pi / 2);
  EXPECT_NEAR(distance(r * Vec3{1, 0, 0}, {0, 1, 0}), 0.0, 1e-15);
  const double h = std::sqrt(0.5);
  EXPECT_NEAR(distance(rotation_from_quaternion(h, 0, 0, h) * Vec3{1, 0, 0}, {0, 1, 0}), 0.0,
              1e-15);
}

}  // namespace
}  // namespace carpus
