// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "imaging/masked_values.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "core/rng.hpp"

namespace carpus::imaging {
namespace {

/// Sizes about a word of 64 bits, masks from empty to full.
TEST(MaskedValues, HasWhatTheImageHasInTheMask) {
  Rng rng(11);
  for (const int length : {0, 1, 63, 64, 65, 1000}) {
    for (const double share : {0.0, 0.02, 0.5, 1.0}) {
      GridGeometry g;
      g.size = {length, 1, 1};
      Grid<std::uint8_t> mask(g);
      Grid<float> image(g);
      std::vector<std::pair<std::size_t, float>> expected;
      for (std::size_t i = 0; i < image.values().size(); ++i) {
        image[i] = static_cast<float>(rng.normal());
        mask[i] = rng.uniform() < share ? 3 : 0;
        if (mask[i] != 0) expected.emplace_back(i, image[i]);
      }
      const MaskedValues values(std::as_const(image).view(), std::as_const(mask).view());
      ASSERT_EQ(values.mask().count(), expected.size());
      std::vector<std::pair<std::size_t, float>> found;
      values.for_each([&](std::size_t i, float value) { found.emplace_back(i, value); });
      EXPECT_EQ(found, expected);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(values.mask().number_of(expected[k].first), k);
        EXPECT_EQ(values[expected[k].first], expected[k].second);
      }
      for (std::size_t i = 0; i < mask.values().size(); ++i) {
        EXPECT_EQ(values.mask().contains(i), mask[i] != 0);
      }
    }
  }
}

}  // namespace
}  // namespace carpus::imaging
