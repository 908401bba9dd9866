// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/sin_cos.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"

namespace carpus {
namespace {

TEST(SinCos, AgreesWithTheLibraryAllAroundTwice) {
  for (int i = -3600; i <= 3600; ++i) {
    const double angle_deg = i / 10.0;
    const SinCos ours = sin_cos_deg(angle_deg);
    EXPECT_NEAR(ours.sin, std::sin(radians_from_degrees(angle_deg)), 1e-13) << angle_deg;
    EXPECT_NEAR(ours.cos, std::cos(radians_from_degrees(angle_deg)), 1e-13) << angle_deg;
  }
}

}  // namespace
}  // namespace carpus
