// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "instruments/screw_torque.hpp"

#include <gtest/gtest.h>

namespace carpus::instruments {
namespace {

TEST(ScrewTorque, RisesWithTheBoneEngagedAndWhatIsDrawnTogetherAndFallsWhenStripped) {
  Threading screw{10, 300, 3.7, 0, false};
  const double half = screw_torque_n_mm(screw);
  screw.engaged_mm = 20;
  const double whole = screw_torque_n_mm(screw);
  EXPECT_NEAR(whole, 50, 1);
  EXPECT_NEAR(half, whole / 2, 1e-9);
  screw.compression_n = 104;  // cadavers' peak [S49]
  const double tight = screw_torque_n_mm(screw);
  EXPECT_NEAR(tight, 127, 2);
  screw.is_stripped = true;
  screw.compression_n = 0;
  EXPECT_LT(screw_torque_n_mm(screw), 0.3 * whole);
  EXPECT_EQ(screw_torque_n_mm({-1, -1000, 3.7, 0, false}), 0);
}

}  // namespace
}  // namespace carpus::instruments
