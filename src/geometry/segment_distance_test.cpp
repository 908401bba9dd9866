// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "geometry/segment_distance.hpp"

#include <gtest/gtest.h>

namespace carpus {
namespace {

TEST(SegmentDistance, HoldsForCrossingParallelAndCollapsedSegments) {
  const Vec3 o{0, 0, 0};
  EXPECT_DOUBLE_EQ(segment_distance({-1, 0, 0}, {1, 0, 0}, {0, -1, 2}, {0, 1, 2}), 2);
  EXPECT_DOUBLE_EQ(segment_distance({-1, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0}), 2);   // in line
  EXPECT_DOUBLE_EQ(segment_distance({-1, 0, 0}, {1, 0, 0}, {-1, 3, 0}, {1, 3, 0}), 3);  // parallel
  EXPECT_DOUBLE_EQ(segment_distance(o, o, {0, 3, 4}, {0, 3, 4}), 5);
  EXPECT_DOUBLE_EQ(segment_distance(o, o, {-1, 2, 0}, {1, 2, 0}), 2);
  EXPECT_DOUBLE_EQ(segment_distance({-1, 2, 0}, {1, 2, 0}, o, o), 2);
}

TEST(NearestOnSegments, SaysHowFarAlongEachOfThem) {
  const NearestOnSegments at = nearest_on_segments({-1, 0, 0}, {3, 0, 0}, {0, -3, 2}, {0, 1, 2});
  EXPECT_DOUBLE_EQ(at.a, 0.25);
  EXPECT_DOUBLE_EQ(at.b, 0.75);
  const NearestOnSegments in_line =
      nearest_on_segments({-1, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0});
  EXPECT_DOUBLE_EQ(in_line.a, 1);
  EXPECT_DOUBLE_EQ(in_line.b, 0);
}

}  // namespace
}  // namespace carpus
