// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Three simulated balls of bone in a row, with cortex, blur and noise: labels with each fault that
// a person mends at the page, one dab of a brush, and what comes of it against the truth.
#include "reconstruct/mend_bones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anatomy/bone_id.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "geometry/triangle_mesh.hpp"
#include "imaging/gaussian.hpp"

namespace carpus::reconstruct {
namespace {

constexpr auto kLunate = static_cast<std::uint8_t>(BoneId::Lunate);
constexpr auto kTriquetrum = static_cast<std::uint8_t>(BoneId::Triquetrum);
constexpr auto kCapitate = static_cast<std::uint8_t>(BoneId::Capitate);
constexpr double kRadius = 5.0;
/// Of the joints; so narrow that a blur of 0.25 mm half fills them.
constexpr double kGap = 0.8;

struct ThreeBones {
  Grid<std::int16_t> ct;
  Grid<std::uint8_t> truth;

  ThreeBones() {
    GridGeometry g;
    g.size = {110, 45, 36};
    g.spacing = {0.4, 0.4, 0.5};
    ct = Grid<std::int16_t>(g);
    truth = Grid<std::uint8_t>(g);
    Grid<float> hu(g);
    for (std::size_t i = 0; i < hu.values().size(); ++i) {
      double nearest = 1e3;
      for (const auto& [label, x] : {std::pair{kLunate, 9.0}, std::pair{kCapitate, middle()},
                                     std::pair{kTriquetrum, 9.0 + 2 * (2 * kRadius + kGap)}}) {
        const double d = distance(place(i), {x, 9, 9}) - kRadius;
        if (d < 0) truth[i] = label;
        nearest = std::min(nearest, d);
      }
      hu[i] = nearest > 0 ? 45.0F : (nearest > -0.8 ? 1200.0F : 300.0F);
    }
    const Grid<float> blurred = imaging::gaussian_smooth(hu.view(), 0.25);
    Rng rng(7);
    for (std::size_t i = 0; i < hu.values().size(); ++i) {
      ct[i] = static_cast<std::int16_t>(
          std::lround(static_cast<double>(blurred[i]) + 25 * rng.normal()));
    }
  }
  static double middle() { return 9.0 + 2 * kRadius + kGap; }
  [[nodiscard]] Vec3 place(std::size_t i) const {
    const GridGeometry& g = truth.geometry();
    const VoxelIndex v = g.index_of(i);
    return {v.x * g.spacing.x, v.y * g.spacing.y, v.z * g.spacing.z};
  }
  void dab(const Vec3& at, std::uint8_t label, Grid<std::uint8_t>& labels) const {
    constexpr double kBrushMm = 2;
    for (std::size_t i = 0; i < labels.values().size(); ++i) {
      if (distance(place(i), at) < kBrushMm) labels[i] = label;
    }
  }
  [[nodiscard]] double dice(const Grid<std::uint8_t>& labels, std::uint8_t label) const {
    std::size_t both = 0, in_labels = 0, in_truth = 0;
    for (std::size_t i = 0; i < labels.values().size(); ++i) {
      both += labels[i] == label && truth[i] == label ? 1 : 0;
      in_labels += labels[i] == label ? 1 : 0;
      in_truth += truth[i] == label ? 1 : 0;
    }
    return 2.0 * static_cast<double>(both) / static_cast<double>(in_labels + in_truth);
  }
};

constexpr double kGood = 0.97;
constexpr MendOptions kGrows{true, {}, {}};

TEST(MendBones, ADabInAForgottenBoneFindsAllOfIt) {
  const ThreeBones scan;
  Grid<std::uint8_t> before = scan.truth;
  for (std::uint8_t& label : before.values()) label = label == kCapitate ? 0 : label;
  Grid<std::uint8_t> painted = before;
  scan.dab({ThreeBones::middle(), 9, 9}, kCapitate, painted);
  const Mended mended = mend_bones(scan.ct.view(), before, painted, kGrows);
  EXPECT_GT(scan.dice(mended.labels, kCapitate), kGood);
  ASSERT_EQ(mended.bones.size(), 1U);
  EXPECT_EQ(mended.bones[0].label, kCapitate);
  EXPECT_EQ(check_surface(mended.bones[0].surface), SurfaceStatus::Ok);
  EXPECT_NEAR(volume_of(mended.bones[0].surface), mended.bones[0].volume_mm3,
              0.03 * mended.bones[0].volume_mm3);
  for (std::size_t i = 0; i < before.values().size(); ++i) {
    if (before[i] != 0) {
      ASSERT_EQ(mended.labels[i], before[i]);
    }
  }
}

TEST(MendBones, ADabInTheSwallowedNeighbourPartsTheTwoAtTheJoint) {
  const ThreeBones scan;
  Grid<std::uint8_t> before = scan.truth;
  for (std::size_t i = 0; i < before.values().size(); ++i) {
    // The joint between them was filled, too.
    const double off = distance(scan.place(i), {0.5 * (9 + ThreeBones::middle()), 9, 9});
    if (before[i] == kCapitate || (before[i] == 0 && off < 1.2)) before[i] = kLunate;
  }
  Grid<std::uint8_t> painted = before;
  scan.dab({ThreeBones::middle() + 1, 9, 9}, kCapitate, painted);
  EXPECT_LT(scan.dice(painted, kLunate), 0.75);
  const Mended mended = mend_bones(scan.ct.view(), before, painted, kGrows);
  EXPECT_GT(scan.dice(mended.labels, kLunate), kGood);
  EXPECT_GT(scan.dice(mended.labels, kCapitate), kGood);
  EXPECT_EQ(scan.dice(mended.labels, kTriquetrum), 1);
  EXPECT_EQ(mended.bones.size(), 2U);
}

TEST(MendBones, WhatWasRubbedOutStaysOutAndTheRestStaysAsItWas) {
  const ThreeBones scan;
  Grid<std::uint8_t> painted = scan.truth;
  const Vec3 at{ThreeBones::middle(), 9 + kRadius, 9};
  scan.dab(at, 0, painted);
  const Mended mended = mend_bones(scan.ct.view(), scan.truth, painted, kGrows);
  for (std::size_t i = 0; i < painted.values().size(); ++i) {
    if (painted[i] != scan.truth[i]) {
      ASSERT_EQ(mended.labels[i], 0);
    }
    // As far as a rim is looked for anew.
    if (distance(scan.place(i), at) > 2 + 2 + 0.5) {
      ASSERT_EQ(mended.labels[i], scan.truth[i]);
    }
  }
}

TEST(MendBones, WithoutWaterABoneIsAsPaintedAndItsSurfaceFollows) {
  const ThreeBones scan;
  Grid<std::uint8_t> painted = scan.truth;
  for (std::uint8_t& label : painted.values()) label = label == kTriquetrum ? 0 : label;
  scan.dab({ThreeBones::middle(), 9, 9 + kRadius + 1}, kCapitate, painted);
  const Mended mended = mend_bones(scan.ct.view(), scan.truth, painted);
  EXPECT_TRUE(
      std::equal(painted.values().begin(), painted.values().end(), mended.labels.values().begin()));
  ASSERT_EQ(mended.bones.size(), 2U);
  EXPECT_EQ(mended.bones[0].label, kTriquetrum);
  EXPECT_EQ(mended.bones[0].volume_mm3, 0);
  EXPECT_TRUE(mended.bones[0].surface.facets.empty());
  EXPECT_EQ(mended.bones[1].label, kCapitate);
  double highest = 0;
  for (const Vec3& v : mended.bones[1].surface.vertices) highest = std::max(highest, v.z);
  EXPECT_GT(highest, 9 + kRadius + 2);
}

TEST(MendBones, RefusesWhatWasNotPaintedAndAnotherGrid) {
  const ThreeBones scan;
  EXPECT_THROW((void)mend_bones(scan.ct.view(), scan.truth, scan.truth), InvalidInput);
  GridGeometry other = scan.truth.geometry();
  other.size[0] -= 1;
  EXPECT_THROW((void)mend_bones(scan.ct.view(), scan.truth, Grid<std::uint8_t>(other)),
               InvalidInput);
}

}  // namespace
}  // namespace carpus::reconstruct
