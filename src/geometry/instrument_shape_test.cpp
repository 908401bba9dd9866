// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/instrument_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus {
namespace {

std::vector<InstrumentShape> one_of_each() {
  return {InstrumentShape(SphereShape{2.0}), InstrumentShape(CapsuleShape{1.5, 20}),
          InstrumentShape(ConeTipShape{0.57, 1.5, 20}),
          InstrumentShape(ThreadedCylinderShape{1.0, 1.5, 0.8, 24})};
}

TEST(Shapes, ReachTheToolsOriginWithTheirForemostPoint) {
  for (const InstrumentShape& shape : one_of_each()) {
    EXPECT_NEAR(shape.signed_distance({0, 0, 0}), 0, 1e-15);
    EXPECT_NEAR(shape.signed_distance({0, 0, -3}), 3, 1e-12);
    EXPECT_GT(shape.signed_distance({0.01, 0, -0.01}), 0);
  }
}

TEST(Shapes, AreTheUnionOfTheirBalls) {
  Rng rng(1);
  for (const InstrumentShape& shape : one_of_each()) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 p{rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(-4, 28)};
      double best = std::numeric_limits<double>::infinity();
      constexpr int kSteps = 4000;
      for (int s = 0; s <= kSteps; ++s) {
        const double z = shape.front_z_mm() + (shape.back_z_mm() - shape.front_z_mm()) * s / kSteps;
        best = std::min(best, distance(p, {0, 0, z}) - shape.radius_at(z));
      }
      ASSERT_LE(shape.signed_distance(p), best + 1e-12);
      ASSERT_NEAR(shape.signed_distance(p), best, 0.01);
    }
  }
}

TEST(Shapes, GiveTheConeItsStraightFlank) {
  const InstrumentShape wire(ConeTipShape{0.57, 1.5, 20});
  for (const double z : {0.1, 0.5, 1.0, 1.3}) {
    EXPECT_NEAR(wire.signed_distance({0.57 * z / 1.5, 0, z}), 0, 1e-12) << z;
  }
  EXPECT_NEAR(wire.signed_distance({0, 0.57, 10}), 0, 1e-12);
  // The edge is rounded by as much as the header says.
  const double full = std::sqrt(0.57 * 0.57 + 1.5 * 1.5);
  const double rounded = std::sqrt((full - 1.5) * (full - 1.5) + 0.57 * 0.57) - 0.57;
  EXPECT_NEAR(wire.signed_distance({0.57, 0, 1.5}), rounded, 1e-12);
  EXPECT_NEAR(rounded, 0.010, 0.001);
}

TEST(Shapes, KnowTheirThread) {
  const InstrumentShape screw(ThreadedCylinderShape{1.0, 1.5, 0.8, 24});
  EXPECT_DOUBLE_EQ(screw.thread().value_or(ScrewThread{}).depth_mm, 0.5);
  EXPECT_DOUBLE_EQ(screw.thread().value_or(ScrewThread{}).pitch_mm, 0.8);
  EXPECT_NEAR(screw.signed_distance({1.5, 0, 12}), 0, 1e-12);
  EXPECT_FALSE(InstrumentShape(SphereShape{}).thread().has_value());
}

TEST(Shapes, RefuseImpossibleMeasures) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(InstrumentShape(SphereShape{0}), InvalidInput);
  EXPECT_THROW(InstrumentShape(SphereShape{nan}), InvalidInput);
  EXPECT_THROW(InstrumentShape(CapsuleShape{2, 3}), InvalidInput);
  EXPECT_NO_THROW(InstrumentShape(CapsuleShape{2, 4}));
  EXPECT_THROW(InstrumentShape(CapsuleShape{1, std::numeric_limits<double>::infinity()}),
               InvalidInput);
  EXPECT_THROW(InstrumentShape(ConeTipShape{1, -1, 20}), InvalidInput);
  EXPECT_THROW(InstrumentShape(ConeTipShape{1, 2, 3}), InvalidInput);
  EXPECT_THROW(InstrumentShape(ThreadedCylinderShape{1.5, 1.5, 1, 20}), InvalidInput);
  EXPECT_THROW(InstrumentShape(ThreadedCylinderShape{1, 1.5, 0, 20}), InvalidInput);
}

}  // namespace
}  // namespace carpus
