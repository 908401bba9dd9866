// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "instruments/drilling_resistance.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace carpus::instruments {
namespace {

TEST(DrillingResistance, LiesInTheProposedRanges) {
  for (const double hu : {150.1, 300.0, 430.0}) {  // cancellous [clinical: B11]
    EXPECT_GE(wire_resistance_n(hu), 2.0);
    EXPECT_LE(wire_resistance_n(hu), 10.0);
  }
  for (const double hu : {620.0, 900.0, 1150.0}) {  // subchondral, far cortex
    EXPECT_GE(wire_resistance_n(hu), 15.0);
    EXPECT_LE(wire_resistance_n(hu), 40.0);
  }
  EXPECT_LT(wire_resistance_n(60.0), 1.0) << "the gap is nearly free";
}

RC_GTEST_PROP(DrillingResistance, GrowsWithDensity, ()) {
  const double hu = *rc::gen::inRange(-1000, 3000);
  const double more = *rc::gen::inRange(0, 500);
  RC_ASSERT(wire_resistance_n(hu + more) >= wire_resistance_n(hu));
}

TEST(DrillingResistance, UnknownDensityResists) {
  EXPECT_GT(wire_resistance_n(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

}  // namespace
}  // namespace carpus::instruments
