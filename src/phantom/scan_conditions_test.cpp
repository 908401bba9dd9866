// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The effects on volumes small enough to know the answer, and the conditions on a coarse phantom.
#include "phantom/scan_conditions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "imaging/binary_mask.hpp"
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

Phantom made_with(Condition condition, double severity) {
  PhantomOptions o = coarse();
  apply(condition, severity, o.scan);
  return make_phantom(o);
}

std::size_t pieces_of(const Phantom& p, BoneId bone) {
  Grid<std::uint8_t> mask(p.labels.geometry());
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    mask[i] = p.labels[i] == static_cast<std::uint8_t>(bone) ? 1 : 0;
  }
  const imaging::Components pieces = imaging::connected_components(mask.view());
  return static_cast<std::size_t>(std::count_if(pieces.voxels.begin(), pieces.voxels.end(),
                                                [](std::size_t n) { return n > 50; }));
}

TEST(ScanConditions, ABipartiteBoneIsOneOfSeveralInTwoHalvesUnderOneName) {
  PhantomOptions o = coarse();
  apply(Condition::Bipartite, 1, o.scan);
  o.scan.bipartite_mm = 2.5;  // seen by voxels of 1 mm
  const Phantom made = make_phantom(o);
  std::size_t in_two = 0;
  for (const BoneId bone : kAllBones) in_two += pieces_of(made, bone) == 2 ? 1U : 0U;
  EXPECT_EQ(in_two, 1U);
}

TEST(ScanConditions, ALunateOfTypeTwoReachesFartherAndTouchesNobody) {
  const Phantom plain = make_phantom(coarse());
  const Phantom made = made_with(Condition::LunateTypeTwo, 1);
  EXPECT_GT(voxels_of(made, BoneId::Lunate), voxels_of(plain, BoneId::Lunate) + 10);
  EXPECT_EQ(pieces_of(made, BoneId::Lunate), 1U);
  for (const BoneId other : {BoneId::Hamate, BoneId::Capitate, BoneId::Triquetrum}) {
    EXPECT_EQ(voxels_of(made, other), voxels_of(plain, other)) << name_of(other);
  }
}

TEST(ScanConditions, AWholeHandHasFingersThatAreNoBoneOfTheCase) {
  const Phantom made = made_with(Condition::WholeHand, 1);
  const GridGeometry& g = made.labels.geometry();
  EXPECT_GT(g.size[2] * g.spacing.z, 180);
  std::size_t dense_beyond = 0;
  for (std::size_t i = 0; i < made.ct.values().size(); ++i) {
    const Vec3 p = (made.wrist_from_patient *
                    Point<frame::Patient>{g.patient_from_voxel(
                        {static_cast<double>(g.index_of(i).x), static_cast<double>(g.index_of(i).y),
                         static_cast<double>(g.index_of(i).z)})})
                       .v;
    if (p.x > -110) continue;  // distal of every metacarpal's head
    dense_beyond += made.ct[i] > 400 ? 1U : 0U;
    ASSERT_EQ(made.labels[i], 0);
  }
  EXPECT_GT(dense_beyond, 3000U);
  for (const BoneId bone : {BoneId::Metacarpal2, BoneId::Metacarpal5}) {
    EXPECT_EQ(pieces_of(made, bone), 1U);
  }
}

TEST(ScanConditions, AnArmOutOfTheFieldOfViewAndAScrewInTheScaphoid) {
  const Phantom plain = make_phantom(coarse());
  const Phantom made = made_with(Condition::CutOff, 1);
  EXPECT_NEAR(plain.ct.geometry().size[0] - made.ct.geometry().size[0], 20, 1);
  const Phantom screwed = made_with(Condition::Screw, 1);
  const auto steel = [](const Phantom& p) {
    std::size_t inside = 0, outside = 0;
    for (std::size_t i = 0; i < p.ct.values().size(); ++i) {
      if (p.ct[i] < 3000) continue;
      (p.labels[i] == static_cast<std::uint8_t>(BoneId::Scaphoid) ? inside : outside) += 1;
    }
    return std::pair{inside, outside};
  };
  EXPECT_EQ(steel(plain).first, 0U);
  EXPECT_GT(steel(screwed).first, 60U);
  EXPECT_LT(steel(screwed).second, steel(screwed).first / 10);
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
