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
#include <vector>

#include "reconstruct/bone_surface.hpp"

namespace carpus::reconstruct {
namespace {

using testing::HasSubstr;

constexpr std::uint8_t kLunate = static_cast<std::uint8_t>(BoneId::Lunate);
constexpr std::uint8_t kCapitate = static_cast<std::uint8_t>(BoneId::Capitate);

/// Two balls of 7 mm radius, in voxels of 0.7 mm if not said otherwise, 3 mm apart, with a sharp
/// edge.
struct TwoBalls {
  Grid<std::uint8_t> labels;
  Grid<float> excess;
  Grid<float> hu;
  anatomy::BoneNaming naming;
  int nameless_below = 0;  ///< slices in which the first ball is a region without a name

  explicit TwoBalls(double spacing = 0.7) {
    const double finer = 0.7 / spacing;
    GridGeometry g;
    g.size = {static_cast<int>(52 * finer), static_cast<int>(26 * finer),
              static_cast<int>(26 * finer)};
    g.spacing = {spacing, spacing, spacing};
    labels = Grid<std::uint8_t>(g);
    excess = Grid<float>(g, -0.5F);
    hu = Grid<float>(g, 45.0F);
    for (std::size_t i = 0; i < labels.values().size(); ++i) {
      const VoxelIndex v = g.index_of(i);
      const auto from = [&](double x) {
        return spacing * length({v.x - x * finer, v.y - 12.5 * finer, v.z - 12.5 * finer});
      };
      if (from(13) < 7) labels[i] = kLunate;
      if (from(37) < 7) labels[i] = kCapitate;
      if (labels[i] != 0) excess[i] = 0.5F;
    }
    naming.regions = {anatomy::RegionName{BoneId::Lunate, BonePart::Whole, 0.4},
                      anatomy::RegionName{BoneId::Capitate, BonePart::Whole, 0.4}, std::nullopt};
  }

  [[nodiscard]] MeshIn<frame::Bone> surface_of(std::uint8_t label) const {
    return build_bone_surface(build_bone_field(labels.view(), label, excess.view()));
  }
  [[nodiscard]] BoneEvidence lunate() const {
    std::vector<LabelSurface> surfaces;
    const auto lunate_surface = surface_of(kLunate);
    const auto capitate_surface = surface_of(kCapitate);
    surfaces.push_back({kLunate, &lunate_surface});
    surfaces.push_back({kCapitate, &capitate_surface});
    Grid<imaging::RegionLabel> regions(labels.geometry());
    for (std::size_t i = 0; i < labels.values().size(); ++i) {
      regions[i] = labels[i] == kLunate ? 1 : (labels[i] == kCapitate ? 2 : 0);
      if (regions[i] == 1 && labels.geometry().index_of(i).z < nameless_below) regions[i] = 3;
    }
    const auto all =
        measure_evidence(labels.view(), imaging::measure_regions(regions.view(), excess.view()),
                         excess.view(), hu.view(), surfaces, naming);
    EXPECT_EQ(all.size(), 2U);
    EXPECT_EQ(all.front().label, kLunate);
    return all.front();
  }
};

TEST(BoneTrust, MeasuresNothingWrongOnASoundBone) {
  const BoneEvidence e = TwoBalls().lunate();
  EXPECT_NEAR(e.volume_mm3, 4.0 / 3 * 3.14159 * 343, 60);
  EXPECT_EQ(e.contact, 0);
  EXPECT_EQ(e.dense_beyond, 0);
  EXPECT_EQ(e.no_edge, 0);
  EXPECT_EQ(e.faint, 0);
  EXPECT_EQ(e.detached, 0);
  EXPECT_NEAR(e.misfit, 0.4, 1e-12);
  EXPECT_GT(e.solidity, 0.95);
  EXPECT_NEAR(e.roughness, 1, 0.05);
  // Area over volume of a ball is 3 / r; cubes are 0.7 to 0.7 sqrt(3) mm wide, 1.05 in the mean.
  EXPECT_NEAR(e.coarseness, 1.05 * 3 / 7, 0.03);
  EXPECT_LT(e.off_edge, 0.05);
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
  EXPECT_GT(balls.lunate().contact, 0.03);
}

TEST(BoneTrust, MeasuresASurfaceWithoutAnEdgeOneThatIsFaintAndOneThatIsElsewhere) {
  TwoBalls faint;
  for (float& value : faint.excess.values()) value *= 0.1F;  // a step of 0.1 of the cortex
  EXPECT_EQ(faint.lunate().faint, 1);
  EXPECT_GT(faint.lunate().blur, 2 * TwoBalls().lunate().blur);
  TwoBalls leaking;
  for (float& value : leaking.excess.values()) value = 0.5F;
  EXPECT_GT(leaking.lunate().no_edge, 0.99);
  EXPECT_GT(leaking.lunate().dense_beyond, 0.99);
  TwoBalls elsewhere;  // the CT's edge lies one voxel farther out than the label's
  const GridGeometry& g = elsewhere.labels.geometry();
  for (std::size_t i = 0; i < elsewhere.labels.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    if (0.7 * length({v.x - 13.0, v.y - 12.5, v.z - 12.5}) < 7.7) elsewhere.excess[i] = 0.5F;
  }
  EXPECT_GT(elsewhere.lunate().off_edge, TwoBalls().lunate().off_edge + 0.1);
}

TEST(BoneTrust, FindsTheSameOnCoarseAndOnFineVoxels) {
  const auto measured = [](double spacing) {
    TwoBalls balls(spacing);
    for (float& value : balls.excess.values()) value *= 0.3F;
    return balls.lunate();
  };
  const BoneEvidence coarse = measured(0.7);
  const BoneEvidence fine = measured(0.35);
  EXPECT_NEAR(fine.roughness, coarse.roughness, 0.05);
  EXPECT_NEAR(fine.dense_beyond, coarse.dense_beyond, 0.02);
  EXPECT_NEAR(fine.no_edge, coarse.no_edge, 0.02);
  EXPECT_NEAR(fine.solidity, coarse.solidity, 0.03);
  EXPECT_NEAR(fine.coarseness, coarse.coarseness / 2, 0.02);
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

TEST(BoneTrust, MeasuresABodyWithoutANameThatGrowsOnIt) {
  EXPECT_EQ(TwoBalls().lunate().severed, 0);
  TwoBalls severed;
  severed.nameless_below = 8;
  EXPECT_GT(severed.lunate().severed, 0.1);
  EXPECT_TRUE(judge(severed.lunate()).flagged);
  EXPECT_NE(judge(severed.lunate()).why.find("join the two"), std::string::npos);
}

BoneEvidence sound() {
  BoneEvidence e;
  e.label = 4;
  e.volume_mm3 = 1400;
  e.misfit = 0.2;
  e.solidity = 0.92;
  e.roughness = 1.15;
  e.contact = 0.01;
  e.dense_beyond = 0.01;
  e.faint = 0.002;
  e.off_edge = 0.02;
  e.blur = 0.25;
  e.coarseness = 0.4;
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
  e = sound();
  e.no_edge = 0.4;
  e.off_edge = 0.3;
  e.faint = 0.5;
  expect_said(e, "no edge");
  e = sound();
  e.coarseness = 1.6;
  e.off_edge = 0.2;
  e.no_edge = 0.06;
  expect_said(e, "voxels are coarse");
}

TEST(BoneTrust, WhereMetalIsTheReasonNoOtherScannerIsAskedFor) {
  EXPECT_EQ(TwoBalls().lunate().metal_mm3, 0);
  TwoBalls pinned;  // a wire of 1.4 x 1.4 mm along the slices' normal, through the first ball
  const GridGeometry& g = pinned.labels.geometry();
  for (int z = 0; z < g.size[2]; ++z) {
    for (int y = 12; y < 14; ++y) {
      for (int x = 12; x < 14; ++x) pinned.hu[VoxelIndex{x, y, z}] = 3071;
    }
  }
  EXPECT_NEAR(pinned.lunate().metal_mm3, 26 * 0.7 * 1.4 * 1.4, 0.1);
  BoneEvidence e = sound();
  e.solidity = 0.6;
  e.coarseness = 1.6;
  e.blur = 2.5;
  e.edge_mm = 1;
  e.off_edge = 0.4;
  e.no_edge = 0.3;
  e.noise_hu = 100;
  e.metal_mm3 = 12;
  const std::string why = judge(e).why;
  EXPECT_THAT(why, HasSubstr("metal in it or beside it"));
  for (const char* wrong : {"thinner", "kernel", "dose", "still"}) {
    EXPECT_THAT(why, testing::Not(HasSubstr(wrong)));
  }
}

TEST(BoneTrust, WhatWasErasedIsNotTheScannersFault) {
  TwoBalls erased;  // a side of the first ball; the CT is as sharp as before
  const GridGeometry& g = erased.labels.geometry();
  for (std::size_t i = 0; i < erased.labels.values().size(); ++i) {
    if (g.index_of(i).x < 13 && erased.labels[i] == kLunate) erased.labels[i] = 0;
  }
  const BoneEvidence e = erased.lunate();
  EXPECT_GT(e.no_edge, 0.1);
  // Half a ball has more surface for its volume; at the surface itself it would be ten times that.
  EXPECT_LT(e.blur, 1.6 * TwoBalls().lunate().blur);
  BoneEvidence hollow = sound();
  hollow.solidity = 0.5;
  hollow.coarseness = 1.2;  // its inner wall counts, too
  hollow.blur = 1.2;
  hollow.edge_mm = 0.5;
  hollow.no_edge = 0.3;
  hollow.off_edge = 0.4;
  for (const BoneEvidence& bone : {e, hollow}) {
    const BoneTrust trust = judge(bone);
    EXPECT_TRUE(trust.flagged);
    EXPECT_THAT(trust.why, HasSubstr("no edge in the CT: draw it there"));
    for (const char* wrong : {"thinner", "kernel", "still"}) {
      EXPECT_THAT(trust.why, testing::Not(HasSubstr(wrong)));
    }
  }
  BoneEvidence blurred = sound();
  blurred.blur = 0.7;
  blurred.edge_mm = 0.8;
  blurred.off_edge = 0.4;
  EXPECT_THAT(judge(blurred).why, HasSubstr("sharper kernel"));
}

TEST(BoneTrust, MoreOfAnyConcernNeverMeansMoreConfidence) {
  const double best = judge(sound()).confidence;
  for (const auto field :
       {&BoneEvidence::misfit, &BoneEvidence::detached, &BoneEvidence::roughness,
        &BoneEvidence::contact, &BoneEvidence::dense_beyond, &BoneEvidence::no_edge,
        &BoneEvidence::faint, &BoneEvidence::off_edge, &BoneEvidence::blur,
        &BoneEvidence::coarseness, &BoneEvidence::noise_hu, &BoneEvidence::wrist_misfit}) {
    BoneEvidence e = sound();
    e.*field += 0.3;
    EXPECT_LE(judge(e).confidence, best);
  }
  EXPECT_EQ(concerns_of(sound()).size(), concern_names().size());
}

}  // namespace
}  // namespace carpus::reconstruct
