// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/metal.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::fluoroscopy {
namespace {

const MetalCylinder kWire = make_wire({0, 0, 0}, {0, 0, 40}, 1.14);

double path_mm(const MetalCylinder& rod, const Vec3& from, const Vec3& to) {
  return line_integral(rod, from, to) / rod.attenuation_per_mm;
}

TEST(Metal, CrossesAWireByItsChord) {
  EXPECT_NEAR(path_mm(kWire, {-100, 0, 20}, {100, 0, 20}), 1.14, 1e-9);
  EXPECT_NEAR(path_mm(kWire, {-100, 0.3, 20}, {100, 0.3, 20}), 2 * std::sqrt(0.57 * 0.57 - 0.09),
              1e-9);
  EXPECT_EQ(path_mm(kWire, {-100, 0.58, 20}, {100, 0.58, 20}), 0.0);
  // At 45 degrees the chord is longer by sqrt 2.
  EXPECT_NEAR(path_mm(kWire, {-20, 0, 0}, {20, 0, 40}), 1.14 * std::sqrt(2.0), 1e-9);
}

TEST(Metal, EndsWhereItsEndsAre) {
  EXPECT_EQ(path_mm(kWire, {-100, 0, -0.01}, {100, 0, -0.01}), 0.0);
  EXPECT_EQ(path_mm(kWire, {-100, 0, 40.01}, {100, 0, 40.01}), 0.0);
  EXPECT_NEAR(path_mm(kWire, {0.2, 0.1, -50}, {0.2, 0.1, 90}), 40, 1e-9) << "seen end on";
  EXPECT_NEAR(path_mm(kWire, {0, 0, 10}, {0, 0, 25}), 15, 1e-9) << "the line ends inside";
}

TEST(Metal, LetsRaysThroughTheBoreOfACannulatedScrew) {
  MetalCylinder screw{{0, 0, 0}, {0, 0, 20}, 1.75, 1.75, 0.6, 0.0, 1.0, kTitaniumPerMm};
  EXPECT_NEAR(path_mm(screw, {-10, 0, 10}, {10, 0, 10}), 3.5 - 1.2, 0.06);
  EXPECT_EQ(path_mm(screw, {0.1, 0, -5}, {0.1, 0, 25}), 0.0) << "end on, through the bore";
  EXPECT_NEAR(path_mm(screw, {1.2, 0, -5}, {1.2, 0, 25}), 20, 1e-6) << "end on, through the wall";
}

TEST(Metal, TapersFromEndToEnd) {
  const MetalCylinder cone{{0, 0, 0}, {0, 0, 20}, 2.0, 1.0, 0.0, 0.0, 1.0, kTitaniumPerMm};
  EXPECT_NEAR(path_mm(cone, {-10, 0, 1}, {10, 0, 1}), 2 * 1.95, 0.03);
  EXPECT_NEAR(path_mm(cone, {-10, 0, 19}, {10, 0, 19}), 2 * 1.05, 0.03);
}

TEST(Metal, ShowsThreadsHalfAPitchApartOnBothSides) {
  const MetalCylinder screw{{0, 0, 0}, {0, 0, 20}, 1.75, 1.75, 0.0, 0.4, 1.0, kTitaniumPerMm};
  // Along a line that grazes the crests beside the axis: metal and gap alternate with the pitch,
  // and the other side does so half a pitch later.
  const auto profile = [&](double x, double z) {
    return path_mm(screw, {x, -10, z}, {x, 10, z}) > 0.1;
  };
  int same = 0;
  int crests = 0;
  constexpr int kSamples = 400;
  for (int i = 0; i < kSamples; ++i) {
    const double z = 4.0 + 10.0 * i / kSamples;
    crests += profile(1.6, z) ? 1 : 0;
    same += profile(1.6, z) == profile(-1.6, z + 0.5) ? 1 : 0;
    EXPECT_EQ(profile(1.6, z), profile(1.6, z + 1.0));
  }
  EXPECT_GT(crests, kSamples / 10);
  EXPECT_LT(crests, kSamples * 9 / 10);
  EXPECT_GT(same, kSamples * 9 / 10);
}

TEST(Metal, LeavesAWireRoomInAHeadlessScrew) {
  const MetalCylinder screw = make_headless_screw({0, 0, 0}, {0, 0, 22}, 3.6, 3.5, 1.14);
  const MetalCylinder wire = make_wire({0, 0, -30}, {0, 0, 30}, 1.14);
  // Across the middle: walls of the screw and the whole wire, no metal counted twice.
  const Vec3 from{-10, 0, 11};
  const Vec3 to{10, 0, 11};
  const double both = path_mm(screw, from, to) + path_mm(wire, from, to);
  EXPECT_LE(both, 3.55);
  EXPECT_GE(both, 3.55 - 2 * 0.35 - 2 * 0.05 - 0.1);
}

TEST(Metal, IsNothingWithoutLengthOrRadius) {
  EXPECT_EQ(path_mm(make_wire({0, 0, 0}, {0, 0, 0}, 1.14), {-1, 0, 0}, {1, 0, 0}), 0.0);
  EXPECT_EQ(path_mm(make_wire({0, 0, 0}, {0, 0, 5}, 0.0), {-1, 0, 2}, {1, 0, 2}), 0.0);
  EXPECT_EQ(path_mm(kWire, {1, 1, 1}, {1, 1, 1}), 0.0);
}

}  // namespace
}  // namespace carpus::fluoroscopy
