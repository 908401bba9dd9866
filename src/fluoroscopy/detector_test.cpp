// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/detector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fluoroscopy/detail/blur.hpp"

namespace carpus::fluoroscopy {
namespace {

AttenuationMap flat(float attenuation, int side = 512) {
  return {side, side, std::vector<float>(static_cast<std::size_t>(side * side), attenuation), {}};
}

/// Relative variance in the middle of the picture: from second differences between pixels some way
/// apart, so that slow shading does not count.
double relative_variance(const std::vector<float>& signal, int side, std::size_t apart = 8) {
  double sum = 0;
  double mean = 0;
  int count = 0;
  for (int j = side / 4; j < side * 3 / 4; ++j) {
    for (int i = side / 4; i < side * 3 / 4; ++i, ++count) {
      const auto at = static_cast<std::size_t>(j * side + i);
      const double d = static_cast<double>(signal[at - apart]) -
                       2 * static_cast<double>(signal[at]) +
                       static_cast<double>(signal[at + apart]);
      sum += d * d / 6;
      mean += static_cast<double>(signal[at]);
    }
  }
  mean /= count;
  return sum / count / (mean * mean);
}

TEST(Detector, HasQuantumNoiseThatFallsWithDose) {
  const CArmGeometry geometry;
  const AttenuationMap map = flat(1.0F);
  Exposure low;
  low.held_mas = 0.02;
  Exposure high = low;
  high.held_mas = 0.2;
  const double ratio = relative_variance(detect(map, geometry, low), map.width) /
                       relative_variance(detect(map, geometry, high), map.width);
  // Ten times the photons, a tenth of the variance; the electronics add up to 7 % at the low dose.
  EXPECT_GT(ratio, 9.3);
  EXPECT_LT(ratio, 11.2);
}

TEST(Detector, HasPoissonNoiseBeforeItsBlur) {
  CArmGeometry geometry;
  geometry.field_mm = 1000;  // pixels of 2 mm: the receptor's blur is below a tenth of a pixel
  Exposure exposure;
  exposure.held_mas = 0.001;
  const AttenuationMap map = flat(0.0F);
  const double variance = relative_variance(detect(map, geometry, exposure), map.width, 1);
  const double photons = open_beam_photons(geometry, exposure);
  // The beam falls off towards the rim: 3 % on average in the middle of the picture, by which the
  // variance rises.
  EXPECT_NEAR(variance * photons, 1.0, 0.06);
}

TEST(Detector, KeepsContrastByTheExponentialLaw) {
  // A far larger field than scatter spreads over: half covered by an attenuation of ln 2.
  CArmGeometry geometry;
  geometry.field_mm = 1000;
  Exposure exposure;
  exposure.held_mas = 100;
  AttenuationMap map = flat(0.0F);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (i % 512 < 256) map.values[i] = std::log(2.0F);
  }
  const std::vector<float> signal = detect(map, geometry, exposure);
  EXPECT_NEAR(static_cast<double>(signal[256 * 512 + 206] / signal[256 * 512 + 306]), 0.5, 0.02);
}

TEST(Detector, CountsDoseByBeamAndField) {
  const CArmGeometry geometry;
  Exposure exposure;
  const double dose = dose_area_product_cgy_cm2(geometry, exposure);
  EXPECT_NEAR(dose, 0.50, 0.005) << "the figure that the header states";
  exposure.beam_mas *= 3;
  EXPECT_NEAR(dose_area_product_cgy_cm2(geometry, exposure), 3 * dose, 1e-12);
  CArmGeometry wide = geometry;
  wide.field_mm *= 1.5;
  EXPECT_NEAR(dose_area_product_cgy_cm2(wide, exposure), 3 * 2.25 * dose, 1e-12);
}

TEST(Display, ShowsBoneDarkOrInvertedAndTheRimBlackEitherWay) {
  const CArmGeometry geometry;
  AttenuationMap map = flat(0.5F);
  for (std::size_t j = 200; j < 300; ++j) {
    for (std::size_t i = 200; i < 300; ++i) map.values[j * 512 + i] = 2.5F;
  }
  map.values[0] = std::numeric_limits<float>::quiet_NaN();
  Exposure exposure;
  const std::vector<float> signal = detect(map, geometry, exposure);
  const Image dark_bone = display(signal, map, geometry, exposure);
  exposure.inverted = true;
  const Image bright_bone = display(signal, map, geometry, exposure);
  EXPECT_LT(dark_bone.grey[250 * 512 + 250] + 100, dark_bone.grey[100 * 512 + 100]);
  EXPECT_GT(bright_bone.grey[250 * 512 + 250], bright_bone.grey[100 * 512 + 100] + 100);
  EXPECT_EQ(dark_bone.grey[0], 0);
  EXPECT_EQ(bright_bone.grey[0], 0);
}

TEST(Display, ShowsMetalDarkerThanTheDensestBoneAndBoneAlikeWithAndWithoutIt) {
  const CArmGeometry geometry;
  AttenuationMap map = flat(1.0F);
  for (std::size_t j = 150; j < 350; ++j) {
    for (std::size_t i = 150; i < 350; ++i) map.values[j * 512 + i] = 4.0F;  // bones over bones
  }
  const Exposure exposure;
  const Image bone = display(detect(map, geometry, exposure), map, geometry, exposure);
  map.metal.assign(map.values.size(), 0.0F);
  for (std::size_t j = 160; j < 340; ++j) {
    for (std::size_t i = 246; i < 254; ++i) {
      map.metal[j * 512 + i] = 3.3F;
      map.values[j * 512 + i] += 3.3F;
    }
  }
  const Image both = display(detect(map, geometry, exposure), map, geometry, exposure);
  EXPECT_LT(both.grey[250 * 512 + 250] + 8, both.grey[250 * 512 + 200]);
  EXPECT_NEAR(both.grey[250 * 512 + 180], bone.grey[250 * 512 + 180], 12);
}

TEST(Display, StaysFiniteWithNothingToSee) {
  const CArmGeometry geometry;
  const Exposure exposure;
  const AttenuationMap covered = flat(std::numeric_limits<float>::quiet_NaN());
  const Image image = display(detect(covered, geometry, exposure), covered, geometry, exposure);
  for (const std::uint8_t grey : image.grey) ASSERT_EQ(grey, 0);
  const AttenuationMap blocked = flat(1000.0F);
  const std::vector<float> signal = detect(blocked, geometry, exposure);
  for (const float value : signal) ASSERT_TRUE(std::isfinite(value));
  EXPECT_EQ(display(signal, blocked, geometry, exposure).grey.size(), 512U * 512U);
}

TEST(Blur, KeepsTheMeanAndSpreadsAPointByItsDeviation) {
  constexpr int kSide = 65;
  std::vector<float> point(kSide * kSide, 0.0F);
  point[32 * kSide + 32] = 1.0F;
  const std::vector<float> blurred = detail::blur_gaussian(point, kSide, kSide, 3.0);
  double sum = 0;
  double second = 0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const auto value = static_cast<double>(blurred[static_cast<std::size_t>(j * kSide + i)]);
      sum += value;
      second += value * (i - 32) * (i - 32);
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_NEAR(second, 9.0, 0.3) << "cut at three deviations";
}

TEST(Blur, LeavesAnEvenPictureEvenAtAnySizeAndWidth) {
  for (const int side : {1, 7, 8, 9, 40}) {
    const std::vector<float> even(static_cast<std::size_t>(side * side), 2.5F);
    for (const std::vector<float>& result : {detail::blur_gaussian(even, side, side, 2.0),
                                             detail::blur_wide(even, side, side, 30.0)}) {
      for (const float value : result) ASSERT_NEAR(value, 2.5F, 1e-5F) << "side " << side;
    }
  }
}

}  // namespace
}  // namespace carpus::fluoroscopy
