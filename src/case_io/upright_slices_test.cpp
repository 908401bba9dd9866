// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/upright_slices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Ten slices, each with one bright pixel in its middle column, in air.
Grid<std::int16_t> slices() {
  GridGeometry g;
  g.size = {9, 7, 10};
  g.spacing = {0.5, 0.5, 1.0};
  g.origin = {1, 2, 3};
  Grid<std::int16_t> made(g, std::int16_t{-1000});
  for (int k = 0; k < g.size[2]; ++k) made[VoxelIndex{4, 3, k}] = 1500;
  return made;
}

std::string refusal(const SliceDrift& drift) {
  try {
    (void)set_upright(slices(), drift, "scan/7.dcm");
  } catch (const IoError& error) {
    return error.what();
  }
  return "none";
}

TEST(UprightSlices, ALineThroughDriftingSlicesLeansInTheBoxThatHoldsIt) {
  for (const double drift : {2.0, -2.0}) {
    const Grid<std::int16_t> box = set_upright(slices(), {0, drift}, "scan/7.dcm");
    const GridGeometry& g = box.geometry();
    EXPECT_EQ(g.size, (std::array<int, 3>{9, 7 + 18, 10}));
    const double first_row = drift < 0 ? 18 : 0;
    EXPECT_NEAR(g.origin.y, 2 - 0.5 * first_row, 1e-12);
    for (int k = 0; k < 10; ++k) {
      const int row = 3 + static_cast<int>(first_row + drift * k);
      EXPECT_EQ(box[(VoxelIndex{4, row, k})], 1500) << drift << ", slice " << k;
      EXPECT_EQ(box[(VoxelIndex{3, row, k})], -1000);
    }
  }
}

TEST(UprightSlices, ABoxBeyondMemoryIsRefusedBeforeItIsAskedFor) {
  EXPECT_THAT(refusal({1e5, 1e5}), AllOf(HasSubstr("scan/7.dcm: needs"), HasSubstr("MB are free")));
}

TEST(UprightSlices, ADriftThatNoGantryHasIsRefused) {
  for (const double drift : {1e6, 1e300, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(refusal({drift, 0}), AllOf(HasSubstr("scan/7.dcm"), HasSubstr("export")));
    EXPECT_THAT(refusal({0, -drift}), HasSubstr("export"));
  }
}

}  // namespace
}  // namespace carpus::case_io
