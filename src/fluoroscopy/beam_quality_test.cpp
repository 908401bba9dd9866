// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/beam_quality.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace carpus::fluoroscopy {
namespace {

TEST(BeamQuality, IsTheUsualAtSixtyToTheBit) {
  EXPECT_EQ(beam_quality(60).soft_tissue, 1.0);
  EXPECT_EQ(beam_quality(60).bone, 1.0);
  EXPECT_EQ(beam_quality(60).metal, 1.0);
}

/// From the tables by hand: at 35 keV water 0.3136, bone 0.9181, iron 5.291 cm2/g; at 44 keV
/// 0.2498, 0.5490, 2.788.
TEST(BeamQuality, FollowsTheTables) {
  const BeamQuality low = beam_quality(50);
  EXPECT_NEAR(low.soft_tissue, 0.3136 / 0.2683, 1e-3);
  EXPECT_NEAR(low.bone, (1.92 * 0.9181 - 0.3136) / (1.92 * 0.6655 - 0.2683), 2e-3);
  EXPECT_NEAR(low.metal, 5.291 / 3.629, 2e-3);
  const BeamQuality high = beam_quality(70);
  EXPECT_NEAR(high.soft_tissue, 0.2498 / 0.2683, 1e-3);
  EXPECT_NEAR(high.bone, (1.92 * 0.5490 - 0.2498) / (1.92 * 0.6655 - 0.2683), 2e-3);
  EXPECT_NEAR(high.metal, 2.788 / 3.629, 2e-3);
}

TEST(BeamQuality, StaysAtTheEndsOfItsRange) {
  EXPECT_EQ(beam_quality(20).bone, beam_quality(50).bone);
  EXPECT_EQ(beam_quality(200).bone, beam_quality(70).bone);
  EXPECT_GT(beam_quality(55).bone, 1.0);
  EXPECT_LT(beam_quality(65).bone, 1.0);
}

}  // namespace
}  // namespace carpus::fluoroscopy
