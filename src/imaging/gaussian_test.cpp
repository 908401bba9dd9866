// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/gaussian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/rng.hpp"
#include "imaging/binary_mask.hpp"
#include "imaging/detail/derivative_engine.hpp"

namespace carpus::imaging {
namespace {

GridGeometry geometry_of(int nx, int ny, int nz, Vec3 spacing) {
  GridGeometry g;
  g.size = {nx, ny, nz};
  g.spacing = spacing;
  return g;
}

template <typename F>
Grid<float> sampled(const GridGeometry& g, const F& f) {
  Grid<float> grid(g);
  for (std::size_t i = 0; i < grid.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    grid[i] = static_cast<float>(f(g.patient_from_voxel(
        {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)})));
  }
  return grid;
}

const GridGeometry kAnisotropic = geometry_of(37, 29, 21, {0.3, 0.4, 0.7});
const VoxelIndex kCentre{18, 14, 10};

TEST(Gaussian, LeavesAConstantAsItIs) {
  const Grid<float> image = sampled(kAnisotropic, [](const Vec3&) { return 417.0; });
  const Grid<float> smooth = gaussian_smooth(image.view(), 0.6);
  for (const float v : smooth.values()) ASSERT_NEAR(v, 417.0, 1e-3);
}

TEST(Gaussian, ASigmaOfZeroIsTheIdentity) {
  Rng rng(1);
  const Grid<float> image = sampled(kAnisotropic, [&](const Vec3&) { return rng.uniform(); });
  const Grid<float> smooth = gaussian_smooth(image.view(), 0.0);
  for (std::size_t i = 0; i < image.values().size(); ++i) ASSERT_EQ(smooth[i], image[i]);
}

TEST(Gaussian, KeepsTheMassOfAPointAndSpreadsItBySigmaInMillimetresOnEveryAxis) {
  Grid<float> image(kAnisotropic);
  image[kCentre] = 1000;
  constexpr double kSigma = 0.8;
  const Grid<float> smooth = gaussian_smooth(image.view(), kSigma);
  double mass = 0;
  Vec3 variance;
  for (std::size_t i = 0; i < smooth.values().size(); ++i) {
    const VoxelIndex v = kAnisotropic.index_of(i);
    const Vec3 d{(v.x - kCentre.x) * 0.3, (v.y - kCentre.y) * 0.4, (v.z - kCentre.z) * 0.7};
    mass += static_cast<double>(smooth[i]);
    variance += Vec3{d.x * d.x, d.y * d.y, d.z * d.z} * static_cast<double>(smooth[i]);
  }
  EXPECT_NEAR(mass, 1000, 0.1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(variance[axis] / mass, kSigma * kSigma, 0.02) << "axis " << axis;
  }
}

TEST(Gaussian, IsSeparableSoSmoothingTwiceAddsVariances) {
  Rng rng(2);
  const Grid<float> image =
      sampled(geometry_of(24, 24, 24, {0.3, 0.3, 0.3}), [&](const Vec3&) { return rng.uniform(); });
  const Grid<float> once = gaussian_smooth(image.view(), 0.75);
  const Grid<float> first = gaussian_smooth(image.view(), 0.45);
  const Grid<float> twice = gaussian_smooth(first.view(), 0.6);
  for (int z = 8; z < 16; ++z) {
    for (int x = 8; x < 16; ++x) {
      EXPECT_NEAR((once[VoxelIndex{x, 12, z}]), (twice[VoxelIndex{x, 12, z}]), 2e-3);
    }
  }
}

TEST(Gaussian, CommutesWithFlippingAnAxis) {
  Rng rng(3);
  const GridGeometry g = geometry_of(17, 11, 9, {0.3, 0.4, 0.7});
  const Grid<float> image = sampled(g, [&](const Vec3&) { return rng.uniform(); });
  Grid<float> flipped(g);
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    flipped[VoxelIndex{16 - v.x, v.y, v.z}] = image[i];
  }
  const Grid<float> a = gradient_magnitude(image.view(), 0.5);
  const Grid<float> b = gradient_magnitude(flipped.view(), 0.5);
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    const VoxelIndex v = g.index_of(i);
    ASSERT_NEAR(a[i], (b[VoxelIndex{16 - v.x, v.y, v.z}]), 1e-4);
  }
}

/// What lies beyond a block's faces is not looked at: they are mirrors.
TEST(Gaussian, OfABlockIsThatOfItsCopy) {
  GridGeometry g;
  g.size = {24, 19, 90};
  g.spacing = {0.3, 0.4, 0.5};
  Grid<std::int16_t> image(g);
  Rng rng(5);
  for (std::int16_t& v : image.values()) v = static_cast<std::int16_t>(rng.below(2000));
  const GridView<const std::int16_t> whole = std::as_const(image).view();
  const VoxelBox box{{3, 0, 7}, {20, 17, 88}};
  const BlockView<std::int16_t> block(whole, box);
  const Grid<std::int16_t> copy = crop(whole, box);
  ASSERT_EQ(block.geometry(), copy.geometry());
  const auto same = [](const Grid<float>& a, const Grid<float>& b) {
    return std::equal(a.values().begin(), a.values().end(), b.values().begin(), b.values().end());
  };
  EXPECT_TRUE(same(gaussian_smooth(block, 0.4), gaussian_smooth(copy.view(), 0.4)));
  EXPECT_TRUE(same(gradient_magnitude(block, 0.4), gradient_magnitude(copy.view(), 0.4)));
  EXPECT_TRUE(same(dark_sheet_measure(block, 0.7), dark_sheet_measure(copy.view(), 0.7)));
}

TEST(GradientMagnitude, OfARampIsItsSlopePerMillimetreWhateverTheVoxels) {
  const Vec3 slope{3, -4, 12};
  const Grid<float> image = sampled(kAnisotropic, [&](const Vec3& p) { return dot(slope, p); });
  for (const double sigma : {0.1, 0.3, 0.6}) {
    const Grid<float> gradient = gradient_magnitude(image.view(), sigma);
    EXPECT_NEAR(gradient[kCentre], 13.0, 0.01) << "sigma " << sigma;
  }
}

TEST(DarkSheet, AnswersToADarkSheetAndNotToABrightOne) {
  const auto sheet = [](double sign) {
    return sampled(geometry_of(40, 40, 40, {0.3, 0.3, 0.3}), [sign](const Vec3& p) {
      const double t = (p.x - 6.0) / 0.5;
      return 300 + sign * 200 * std::exp(-0.5 * t * t);
    });
  };
  const VoxelIndex on_sheet{20, 20, 20};
  const Grid<float> dark = dark_sheet_measure(sheet(-1).view(), 0.5);
  const Grid<float> bright = dark_sheet_measure(sheet(+1).view(), 0.5);
  // A Gaussian dip of width 0.5 seen with sigma 0.5: 200 * 0.5^3 / (0.5^2 + 0.5^2)^(3/2) = 70.7.
  EXPECT_NEAR(dark[on_sheet], 70.7, 2.0);
  EXPECT_NEAR(bright[on_sheet], 0.0, 0.5);
}

}  // namespace
}  // namespace carpus::imaging
