// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/bone_bitmap.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <utility>

#include "case_io/small_case_test_support.hpp"

namespace carpus::case_io {
namespace {

/// A CT of one density about the octahedron at the origin.
Grid<std::int16_t> ct_of(std::int16_t hu) {
  GridGeometry g;
  g.size = {40, 40, 40};
  g.origin = {-20, -20, -20};
  Grid<std::int16_t> ct(g);
  for (std::int16_t& v : ct.values()) v = hu;
  return ct;
}

double mean_of(const BoneBitmap& bitmap) {
  return std::accumulate(bitmap.texels.begin(), bitmap.texels.end(), 0.0) /
         static_cast<double>(bitmap.texels.size());
}

TEST(BoneBitmap, DenseBoneIsPalerThanPorousBoneAndBothHaveGrain) {
  const cases::Bone bone = test::octahedron(BoneId::Lunate, BonePart::Whole, 4, {0, 0, 0});
  const auto dense = ct_of(1200);
  const auto porous = ct_of(100);
  const BoneBitmap pale = make_bone_bitmap(bone, std::as_const(dense).view(), 64);
  const BoneBitmap dark = make_bone_bitmap(bone, std::as_const(porous).view(), 64);
  EXPECT_NEAR(mean_of(pale) - mean_of(dark), 0.55 * 255, 3);
  const auto [low, high] = std::minmax_element(dark.texels.begin(), dark.texels.end());
  EXPECT_GT(*high - *low, 25);
  const auto palette = BoneBitmap::palette();
  EXPECT_GT(palette[255][2], palette[0][2]);
  EXPECT_EQ(pale.png().substr(1, 3), "PNG");
}

TEST(BoneBitmap, IsTheSameEachTimeAndWorksWithoutACt) {
  const cases::Bone bone = test::octahedron(BoneId::Lunate, BonePart::Whole, 4, {3, 1, 2});
  const Grid<std::int16_t> none;
  const BoneBitmap one = make_bone_bitmap(bone, none.view(), 64);
  EXPECT_EQ(one.texels, make_bone_bitmap(bone, none.view(), 64).texels);
  EXPECT_EQ(one.atlas.facets.size(), bone.surface.facets.size());
}

}  // namespace
}  // namespace carpus::case_io
