// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/optics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::arthroscopy {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180;
constexpr Vec3 kDistal{0, 1, 0};
const ScopeHold kHeld{{1, 2, 3}, {0, 0, 1}, 0, 0};

/// A point so far from the eye, at polar angle `from_axis` and azimuth `clockwise` from up.
Vec3 seen_at(const Sight& s, double from_axis_deg, double clockwise_deg, double mm) {
  const double t = from_axis_deg * kRadPerDeg;
  const double a = clockwise_deg * kRadPerDeg;
  return s.eye +
         (s.axis * std::cos(t) + (s.up * std::cos(a) + s.right * std::sin(a)) * std::sin(t)) * mm;
}

TEST(Optics, AnglesOfAnySizeAreTheLibrarysToTwelveDigits) {
  for (double deg = -1000; deg <= 1000; deg += 3.7) {
    const auto [c, s] = cos_sin_deg(deg);
    EXPECT_NEAR(c, std::cos(deg * kRadPerDeg), 1e-12);
    EXPECT_NEAR(s, std::sin(deg * kRadPerDeg), 1e-12);
  }
}

TEST(Optics, LooksAsideByItsViewAngleTowardsWhatIsLevel) {
  for (const double angle : {0.0, 30.0, 70.0}) {
    const Sight s = sight_of({angle, 80}, kHeld, kDistal);
    EXPECT_NEAR(dot(s.axis, {0, 0, -1}), std::cos(angle * kRadPerDeg), 1e-12);
    EXPECT_NEAR(dot(s.axis, kDistal), std::sin(angle * kRadPerDeg), 1e-12);
    EXPECT_NEAR(length(cross(s.right, s.up) + s.axis), 0, 1e-12);
  }
}

TEST(Optics, TurningTheShaftTurnsTheSightAndKeepsTheHorizon) {
  for (double turn = -165; turn <= 165; turn += 15) {
    const Sight s = sight_of({30, 80}, {{}, {0, 0, 1}, turn, 0}, kDistal);
    EXPECT_NEAR(dot(s.axis, {0, 0, -1}), std::cos(30 * kRadPerDeg), 1e-12);
    EXPECT_NEAR(std::atan2(-s.axis.x, s.axis.y) / kRadPerDeg, turn, 1e-9);
    EXPECT_NEAR(horizon_cosine(s, kDistal), 1, 1e-12);
  }
}

TEST(Optics, TurningTheCameraHeadTiltsTheHorizonAndKeepsTheSight) {
  const Sight level = sight_of({0, 80}, kHeld, kDistal);
  ScopeHold tilted = kHeld;
  tilted.camera_turn_deg = 40;
  const Sight s = sight_of({0, 80}, tilted, kDistal);
  EXPECT_NEAR(distance(s.axis, level.axis), 0, 1e-12);
  EXPECT_NEAR(horizon_cosine(s, kDistal), std::cos(40 * kRadPerDeg), 1e-12);
}

/// The lens model by hand: r = R * angle / half the field; within half a pixel and far better.
TEST(Optics, PutsAPointWhereTheLensModelPutsIt) {
  constexpr double kDiameterPx = 720;
  for (const double view : {0.0, 30.0, 70.0}) {
    for (const double field : {75.0, 80.0, 115.0}) {
      const Lens lens{view, field};
      const Sight s =
          sight_of(lens, {{4, -2, 9}, normalized_or({0.2, -0.3, 1}, {}), 77, -31}, kDistal);
      for (double from = 0; from < field / 2; from += 4.9) {
        for (double at = 0; at < 360; at += 33) {
          const auto pixel = project(lens, s, kDiameterPx, seen_at(s, from, at, 7));
          ASSERT_TRUE(pixel.has_value());
          const double r = kDiameterPx / 2 * from / (field / 2);
          EXPECT_NEAR(pixel->right, r * std::sin(at * kRadPerDeg), 0.001);
          EXPECT_NEAR(pixel->down, -r * std::cos(at * kRadPerDeg), 0.001);
        }
      }
    }
  }
}

TEST(Optics, OutsideTheRoundPictureNothingIsSeen) {
  const Lens lens{30, 80};
  const Sight s = sight_of(lens, kHeld, kDistal);
  EXPECT_TRUE(is_in_field(s, seen_at(s, 39.9, 10, 5)));
  EXPECT_FALSE(is_in_field(s, seen_at(s, 40.1, 10, 5)));
  EXPECT_FALSE(is_in_field(s, seen_at(s, 179, 10, 5)));
  EXPECT_FALSE(project(lens, s, 720, seen_at(s, 40.1, 200, 5)).has_value());
}

TEST(Optics, NoShaftAndNoLevelGivesNoNumberThatIsNone) {
  for (const Vec3& level : {Vec3{0, 0, 1}, Vec3{}, Vec3{0, 0, -5}}) {
    const Sight s = sight_of({30, 80}, kHeld, level);
    EXPECT_TRUE(is_finite(s.axis) && is_finite(s.up) && is_finite(s.right));
    EXPECT_NEAR(length(s.up), 1, 1e-9);
  }
}

}  // namespace
}  // namespace carpus::arthroscopy
