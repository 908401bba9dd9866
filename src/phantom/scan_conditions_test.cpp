// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The effects on volumes small enough to know the answer, and the conditions on a coarse phantom.
#include "phantom/scan_conditions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "phantom/phantom.hpp"
#include "phantom/scanner_effects.hpp"

namespace carpus::phantom {
namespace {

GridGeometry cube(int n, double spacing) {
  GridGeometry g;
  g.size = {n, n, n};
  g.spacing = {spacing, spacing, spacing};
  return g;
}

double at(const Grid<float>& grid, const VoxelIndex& v) { return static_cast<double>(grid[v]); }

TEST(ScanConditions, HaveNamesAndGrowWithSeverity) {
  for (const Condition condition : kAllConditions) {
    EXPECT_EQ(condition_of(name_of(condition)), condition);
  }
  EXPECT_FALSE(condition_of("no such thing"));
  ScanOptions mild, severe;
  apply(Condition::LowDose, 0, mild);
  apply(Condition::LowDose, 1, severe);
  EXPECT_GT(mild.noise_hu, ScanOptions{}.noise_hu);
  EXPECT_GT(severe.noise_hu, 2 * mild.noise_hu);
}

/// Amplitude of a wave of wavelength `mm` after the kernel, of 1 before.
double transfer(double wavelength_mm, const ScanOptions& options) {
  Grid<float> hu(cube(64, 0.25));
  for (std::size_t i = 0; i < hu.values().size(); ++i) {
    const VoxelIndex v = hu.geometry().index_of(i);
    hu[i] = static_cast<float>(std::cos(2 * 3.14159265 * 0.25 * (v.x - 32) / wavelength_mm));
  }
  return static_cast<double>(blurred_by_kernel(hu, options)[VoxelIndex{32, 32, 32}]);
}

TEST(ScannerEffects, TheKernelHasTheStatedTransferFunction) {
  const auto gauss = [](double fwhm, double wavelength) {
    const double s = 0.425 * fwhm;
    return std::exp(-2 * 9.8696 * s * s / (wavelength * wavelength));
  };
  ScanOptions o;
  for (const double wavelength : {2.0, 4.0}) {
    EXPECT_NEAR(transfer(wavelength, o), gauss(0.6, wavelength), 0.02);
    ScanOptions sharp = o;
    sharp.edge_enhancement = 0.5;
    EXPECT_NEAR(transfer(wavelength, sharp),
                gauss(0.6, wavelength) * (1 + 0.5 * (1 - gauss(0.9, wavelength))), 0.02);
  }
}

TEST(ScannerEffects, HardeningDarkensAlongThePathThroughBone) {
  Grid<float> hu(cube(41, 1.0), 0.0F);
  for (int x = 10; x < 30; ++x) hu[VoxelIndex{x, 20, 5}] = 1350;  // 20 mm of cortex along x
  harden_beam(100, hu);
  EXPECT_NEAR(at(hu, {2, 20, 5}), -25, 0.01);  // one of four directions
  EXPECT_EQ(at(hu, {2, 20, 6}), 0);
  EXPECT_LT(at(hu, {20, 20, 5}), 1350 - 25);
}

TEST(ScannerEffects, AWireIsSteelWithAStarThatFades) {
  Grid<float> hu(cube(60, 0.5), 0.0F);
  add_wire({{15, 15, 2}, {15, 15, 28}, 1.0}, 300, 3, hu);
  EXPECT_EQ(at(hu, {30, 30, 30}), 8000);
  double near = 0, far = 0;
  for (int y = 0; y < 60; ++y) {
    near = std::max(near, std::abs(at(hu, {36, y, 30})));
    far = std::max(far, std::abs(at(hu, {1, y, 30})));
  }
  EXPECT_GT(near, 1.5 * far);
  EXPECT_GT(near, 60);
}

TEST(ScannerEffects, MotionMovesOneSideAndSlicesKeepTheirMean) {
  Grid<float> hu(cube(6, 1.0), 1.0F);
  step_aside(3, 2, -1000.0F, hu);
  EXPECT_EQ(at(hu, {1, 1, 3}), -1000);
  EXPECT_EQ(at(hu, {2, 1, 3}), 1);
  EXPECT_EQ(at(hu, {1, 1, 2}), 1);
  const Grid<float> thick = merged_slices(hu, 2);
  EXPECT_EQ(thick.geometry().size[2], 3);
  EXPECT_EQ(thick.geometry().spacing.z, 2);
  EXPECT_NEAR(at(thick, {0, 0, 1}), (1.0F - 1000.0F) / 2, 1e-3);
  EXPECT_NEAR(thick.geometry().origin.z, 0.5, 1e-12);
}

PhantomOptions coarse() {
  PhantomOptions o;
  o.spacing = {1.0, 1.0, 1.0};
  o.fracture = FractureKind::None;
  return o;
}

std::size_t voxels_of(const Phantom& p, BoneId bone) {
  return static_cast<std::size_t>(std::count(p.labels.values().begin(), p.labels.values().end(),
                                             static_cast<std::uint8_t>(bone)));
}

TEST(ScanConditions, EachChangesThePhantomAndKeepsItsCarpus) {
  PhantomOptions o = coarse();
  apply(Condition::OtherAnatomy, 0.5, o.scan);
  apply(Condition::ScapholunateGap, 0.5, o.scan);
  apply(Condition::ShortForearm, 0.5, o.scan);
  const Phantom plain = make_phantom(coarse());
  const Phantom made = make_phantom(o);
  EXPECT_LT(made.labels.geometry().size[2], plain.labels.geometry().size[2]);
  for (const BoneId bone : {BoneId::Scaphoid, BoneId::Lunate, BoneId::Capitate}) {
    const auto before = static_cast<double>(voxels_of(plain, bone));
    EXPECT_NEAR(static_cast<double>(voxels_of(made, bone)) / before, 1, 0.3) << name_of(bone);
  }
}

TEST(ScanConditions, ThickSlicesAndLessDensity) {
  PhantomOptions o = coarse();
  apply(Condition::Osteoporosis, 1, o.scan);
  o.scan.slice_mm = 2;
  const Phantom made = make_phantom(o);
  EXPECT_EQ(made.ct.geometry().spacing.z, 2);
  EXPECT_TRUE(made.ct.geometry().size == made.labels.geometry().size);
  const auto densest = *std::max_element(made.ct.values().begin(), made.ct.values().end());
  EXPECT_LT(densest, 1000);
}

}  // namespace
}  // namespace carpus::phantom
