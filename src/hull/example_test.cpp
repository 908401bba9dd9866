// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The library in ten lines.
#include <gtest/gtest.h>

#include <vector>

#include "hull/fast_hull.hpp"
#include "hull/merged_faces.hpp"
#include "hull/polytope_measures.hpp"

namespace {

TEST(Example, TakesTheHullOfAPyramidWithAPointInside) {
  const std::vector<carpus::Vec3> points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0},
                                         {0, 2, 0}, {1, 1, 3}, {1, 1, 1}};  // mm
  const carpus::hull::HullResult hull = carpus::hull::build_fast_hull(points);
  ASSERT_EQ(hull.status, carpus::hull::HullStatus::Ok);
  EXPECT_EQ(hull.polytope.input_indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(hull.polytope.facets.size(), 6U);                       // triangles
  EXPECT_EQ(carpus::hull::merged_faces(hull.polytope).size(), 5U);  // a square and four
  EXPECT_DOUBLE_EQ(carpus::hull::measures_of(hull.polytope).volume_mm3, 4.0);
}

}  // namespace
