// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two bones as blocks of voxels with an edge all around them; then each fault that is looked for,
// put in by hand, must be measured, flagged and said.
#include "reconstruct/bone_trust.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carpus::reconstruct {
namespace {

using testing::HasSubstr;

constexpr std::uint16_t kLunate = static_cast<std::uint16_t>(BoneId::Lunate);
constexpr std::uint16_t kCapitate = static_cast<std::uint16_t>(BoneId::Capitate);

/// Two balls of 7 mm radius in voxels of 0.7 mm, 2 mm apart, with a sharp edge.
struct TwoBalls {
  Grid<std::uint16_t> labels;
  Grid<float> excess;
  Grid<float> hu;
  anatomy::BoneNaming naming;

  TwoBalls() {
    GridGeometry g;
    g.size = {52, 26, 26};
    g.spacing = {0.7, 0.7, 0.7};
    labels = Grid<std::uint16_t>(g);
    excess = Grid<float>(g, -0.5F);
    hu = Grid<float>(g, 45.0F);
    for (std::size_t i = 0; i < labels.values().size(); ++i) {
      const VoxelIndex v = g.index_of(i);
      const auto from = [&](double x) { return 0.7 * length({v.x - x, v.y - 12.5, v.z - 12.5}); };
      if (from(13) < 7) labels[i] = kLunate;
      if (from(37) < 7) labels[i] = kCapitate;
      if (labels[i] != 0) excess[i] = 0.5F;
    }
    naming.regions = {anatomy::RegionName{BoneId::Lunate, BonePart::Whole, 0.4},
                      anatomy::RegionName{BoneId::Capitate, BonePart::Whole, 0.4}};
  }

  [[nodiscard]] BoneEvidence lunate() const {
    const auto all = measure_evidence(labels.view(), excess.view(), hu.view(), naming);
    EXPECT_EQ(all.size(), 2U);
    EXPECT_EQ(all.front().label, kLunate);
    return all.front();
  }
};

TEST(BoneTrust, MeasuresNothingWrongOnASoundBone) {
  const BoneEvidence e = TwoBalls().lunate();
  EXPECT_NEAR(e.volume_mm3, 4.0 / 3 * 3.14159 * 343, 60);
  EXPECT_EQ(e.leak, 0);
  EXPECT_EQ(e.weak_rim, 0);
  EXPECT_EQ(e.unsteady, 0);
  EXPECT_EQ(e.detached, 0);
  EXPECT_NEAR(e.misfit, 0.4, 1e-12);
  EXPECT_GT(e.solidity, 0.95);
  EXPECT_NEAR(e.roughness, 1.5, 0.1);  // a ball of cubes has 1.5 times its area
}

TEST(BoneTrust, MeasuresWhereOneBoneTouchesAnother) {
  TwoBalls balls;
  const GridGeometry& g = balls.labels.geometry();
  for (std::size_t i = 0; i < balls.labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (v.x >= 20 && v.x < 32 && std::abs(v.y - 12) < 5 && std::abs(v.z - 12) < 5) {
      balls.labels[i] = v.x < 25 ? kLunate : kCapitate;
    }
  }
  EXPECT_GT(balls.lunate().leak, 0.03);
}

TEST(BoneTrust, MeasuresABorderWithoutAnEdgeAndOneThatMovesWithTheThreshold) {
  TwoBalls balls;
  for (float& value : balls.excess.values()) value *= 0.1F;  // a step of 0.1 of the cortex
  const BoneEvidence e = balls.lunate();
  EXPECT_EQ(e.weak_rim, 1);
  EXPECT_GT(e.unsteady, 0.2);
}

TEST(BoneTrust, MeasuresAPieceApartAndAHollow) {
  TwoBalls balls;
  for (int z = 2; z < 6; ++z) balls.labels[VoxelIndex{2, 2, z}] = kLunate;
  EXPECT_GT(balls.lunate().detached, 0);
  TwoBalls hollow;
  const GridGeometry& g = hollow.labels.geometry();
  for (std::size_t i = 0; i < hollow.labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (0.7 * length({v.x - 13.0, v.y - 12.5, v.z - 12.5}) < 5.8) hollow.labels[i] = 0;
  }
  EXPECT_LT(hollow.lunate().solidity, 0.6);
}

BoneEvidence sound() {
  BoneEvidence e;
  e.label = 4;
  e.volume_mm3 = 1400;
  e.misfit = 0.2;
  e.solidity = 0.92;
  e.weak_rim = 0.005;
  e.unsteady = 0.02;
  e.roughness = 1.6;
  e.noise_hu = 8;
  return e;
}

TEST(BoneTrust, FlagsEachFaultAndSaysWhatToDo) {
  EXPECT_FALSE(judge(sound()).flagged);
  EXPECT_EQ(judge(sound()).why, "");
  const auto expect_said = [](const BoneEvidence& e, const char* words) {
    const BoneTrust trust = judge(e);
    EXPECT_TRUE(trust.flagged) << words;
    EXPECT_THAT(trust.why, HasSubstr(words));
    EXPECT_GE(trust.confidence, 0);
    EXPECT_LT(trust.confidence, judge(sound()).confidence);
  };
  BoneEvidence e = sound();
  e.misfit = 20;
  expect_said(e, "check its name");
  e = sound();
  e.volume_ratio = 0.35;
  expect_said(e, "lost a part");
  e = sound();
  e.detached = 0.2;
  expect_said(e, "lies apart");
}

TEST(BoneTrust, MoreOfAnyConcernNeverMeansMoreConfidence) {
  const double best = judge(sound()).confidence;
  for (const auto field : {&BoneEvidence::misfit, &BoneEvidence::leak, &BoneEvidence::weak_rim,
                           &BoneEvidence::unsteady, &BoneEvidence::detached,
                           &BoneEvidence::roughness, &BoneEvidence::noise_hu}) {
    BoneEvidence e = sound();
    e.*field += 0.3;
    EXPECT_LE(judge(e).confidence, best);
  }
  EXPECT_EQ(concerns_of(sound()).size(), concern_names().size());
}

}  // namespace
}  // namespace carpus::reconstruct
