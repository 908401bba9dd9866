// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/opened_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace carpus::arthroscopy {
namespace {

/// A gap of 2 mm about z = 0, between a forearm below and a row above.
Grid<float> gap() {
  GridGeometry geometry;
  geometry.size = {21, 21, 21};
  geometry.spacing = {0.5, 0.5, 0.5};
  geometry.origin = {-5, -5, -5};
  std::vector<float> values;
  for (int z = 0; z < 21; ++z) {
    for (int i = 0; i < 21 * 21; ++i) {
      values.push_back(static_cast<float>(std::abs(-5 + 0.5 * z) - 1.0));
    }
  }
  return {geometry, values};
}

TEST(OpenedSpace, ReachesFromTheForearmToWhereTheRowHasGone) {
  const Grid<float> space = gap();
  const Pose<frame::Bone, frame::Patient> forearm;
  Pose<frame::Patient, frame::Bone> pulled;
  pulled.translation = {0, 0, 1.5};
  const auto row = pulled.inverse();
  EXPECT_LT(opened_space_at(space, forearm, row, {0, 0, -0.8}).distance_mm, 0);
  EXPECT_LT(opened_space_at(space, forearm, row, {0, 0, 0.75}).distance_mm, 0);
  EXPECT_LT(opened_space_at(space, forearm, row, {0, 0, 2.3}).distance_mm, 0);
  const OpenedSpace below = opened_space_at(space, forearm, row, {0, 0, -1.5});
  EXPECT_NEAR(below.distance_mm, 0.5, 1e-6);
  EXPECT_LT(below.outwards.z, -0.99);
  const OpenedSpace above = opened_space_at(space, forearm, row, {0, 0, 3.0});
  EXPECT_NEAR(above.distance_mm, 0.5, 1e-6);
  EXPECT_GT(above.outwards.z, 0.99);
}

TEST(OpenedSpace, WithoutPullIsTheSpaceItself) {
  const Grid<float> space = gap();
  EXPECT_NEAR(opened_space_at(space, {}, {}, {0, 0, 1.5}).distance_mm, 0.5, 1e-6);
  EXPECT_FALSE(opened_space_at(space, {}, {}, {0, 0, 50}).is_near);
}

}  // namespace
}  // namespace carpus::arthroscopy
