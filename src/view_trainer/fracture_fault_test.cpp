// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/fracture_fault.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::view_trainer {
namespace {

/// Faces across z: 2 mm apart, led off by 1.5 mm along x.
constexpr FractureFault kFault{{0, 0, 1}, {1.5, 0, 2}};

TEST(FractureFault, GapIsClearAlongItsFacesAndHiddenFromBesideThem) {
  EXPECT_DOUBLE_EQ(clear_gap_mm(kFault, {1, 0, 0}), 2.0);
  EXPECT_DOUBLE_EQ(clear_gap_mm(kFault, {0, 1, 0}), 2.0);
  EXPECT_DOUBLE_EQ(clear_gap_mm(kFault, {0, 0, -1}), -kFaceAcrossMm);
  // A slot of 2 mm by kFaceAcrossMm closes at the angle whose tangent is their ratio.
  const double closes = std::atan2(2.0, kFaceAcrossMm);
  EXPECT_NEAR(clear_gap_mm(kFault, {std::cos(closes), 0, std::sin(closes)}), 0.0, 1e-12);
}

TEST(FractureFault, StepIsSeenFromAcrossIt) {
  EXPECT_DOUBLE_EQ(seen_step_mm(kFault, {0, 1, 0}), 1.5);
  EXPECT_DOUBLE_EQ(seen_step_mm(kFault, {1, 0, 0}), 0.0);
  EXPECT_NEAR(seen_step_mm(kFault, {std::sqrt(0.5), std::sqrt(0.5), 0}), 1.5 * std::sqrt(0.5),
              1e-12);
}

}  // namespace
}  // namespace carpus::view_trainer
