// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/features/body_levels.hpp"

#include <gtest/gtest.h>

#include "convex/bodies_test_support.hpp"
#include "convex/features/feature_test_support.hpp"

namespace carpus::survey {
namespace {

TEST(BodyLevels, ShrinkToAFewVerticesWithinTheFinerOnes) {
  Rng rng(1);
  for (const int count : {20, 100, 400}) {
    const BodyLevels levels(test::round_body(rng, count));
    EXPECT_LE(levels[levels.size() - 1].features.vertex_count(), 20U);
    for (std::size_t k = 1; k < levels.size(); ++k) {
      const convex::VoronoiFeatures& fine = levels[k - 1].features;
      const convex::VoronoiFeatures& coarse = levels[k].features;
      EXPECT_LT(coarse.vertex_count(), fine.vertex_count());
      ASSERT_EQ(levels[k].finer.size(), coarse.vertex_count());
      ASSERT_EQ(levels[k - 1].coarser.size(), fine.vertex_count());
      for (std::uint32_t v = 0; v < coarse.vertex_count(); ++v) {
        EXPECT_EQ(coarse.vertex(v), fine.vertex(levels[k].finer[v]));
        EXPECT_EQ(levels[k - 1].coarser[levels[k].finer[v]], v);
      }
    }
  }
}

TEST(BodyLevels, DeviateFromTheBodyByWhatTheySay) {
  Rng rng(2);
  const BodyLevels levels(test::round_body(rng, 300));
  EXPECT_EQ(levels[0].deviation_mm, 0);
  double before = 0;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    double least = 0;  // heights over planes are lower bounds of the distance outside
    for (const Vec3& v : levels[0].features.vertices()) {
      for (const Plane& p : levels[k].features.planes()) {
        least = std::max(least, p.signed_distance(v));
      }
    }
    EXPECT_GE(levels[k].deviation_mm, least);
    EXPECT_LE(levels[k].deviation_mm, 2 * least + 1e-6);
    EXPECT_GT(levels[k].deviation_mm, before);
    before = levels[k].deviation_mm;
  }
}

TEST(BodyLevels, OfABodyWithFewVerticesAreOne) {
  EXPECT_EQ(BodyLevels(test::box({1, 2, 3})).size(), 1U);
}

}  // namespace
}  // namespace carpus::survey
