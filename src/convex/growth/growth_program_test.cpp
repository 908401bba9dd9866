// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The simplex method by itself: queries of growth.hpp seldom get so far.
#include "convex/growth/growth_program.hpp"

#include <gtest/gtest.h>

#include "convex/bodies_test_support.hpp"
#include "convex/exact_meeting.hpp"
#include "core/rng.hpp"

namespace carpus::convex {
namespace {

TEST(GrowthProgram, DecidesByPivotsAloneWhatExactNumbersDecide) {
  Rng rng(12);
  GrowthCounts counts;
  int unknown = 0;
  int meets = 0;
  for (int k = 0; k < 20; ++k) {
    const ConvexBody first = test::pebble(rng, 10 + 20 * k);
    const ConvexBody second = test::pebble(rng, 10 + 20 * k);
    const ProofBody first_proofs(first);
    const ProofBody second_proofs(second);
    const GrowthProgram program(first_proofs, second_proofs);
    GrowthMemory memory;
    PairPose pose{Mat3::identity(), {13, 3, -4}};
    for (int tick = 0; tick < 200; ++tick) {
      const double step = tick % 10 == 0 ? 3 : 0.3;
      pose = {rotation_about(test::random_direction(rng), 0.05 * step) * pose.rotation,
              pose.translation + test::random_direction(rng) * rng.uniform(0, step)};
      pose.translation *= length(pose.translation) > 20 ? 0.8 : 1.0;
      RelativePose relative;
      ASSERT_TRUE(relative_pose(program.first(), program.second(), pose, relative));
      const Verdict verdict = program.decide_by_pivots(relative, memory, counts);
      const Verdict exact = exactly_meet({&first, Mat3::identity(), {}},
                                         {&second, pose.rotation, pose.translation}, {})
                                .verdict;
      if (verdict == Verdict::Unknown) {
        ++unknown;
      } else {
        ASSERT_EQ(verdict, exact) << k << " " << tick;
      }
      meets += exact == Verdict::Meet ? 1 : 0;
    }
  }
  EXPECT_EQ(unknown, 0);
  EXPECT_GT(meets, 400);
  EXPECT_LT(meets, 3600);
  EXPECT_GT(counts.pivots, 500U);
  EXPECT_EQ(counts.pivot_limits, 0U);
}

TEST(GrowthProgram, GoesOnAtItsRowsAfterPivotsAndWithoutThem) {
  Rng rng(13);
  const ConvexBody first = test::pebble(rng, 200);
  const ConvexBody second = test::pebble(rng, 200);
  const ProofBody first_proofs(first);
  const ProofBody second_proofs(second);
  const GrowthProgram program(first_proofs, second_proofs);
  GrowthMemory memory;
  GrowthCounts counts;
  RelativePose relative;
  ASSERT_TRUE(
      relative_pose(program.first(), program.second(), {Mat3::identity(), {22, 3, -4}}, relative));
  EXPECT_EQ(program.look_at_rows(relative, memory), GrowthLook::Open);  // none yet
  const GrowthOptimum best = program.optimum(relative, memory, counts);
  relative.offset *= (1 + 1e-7) / best.lower;  // all but touching, at the same rows
  ASSERT_TRUE(memory.has_basis());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(memory.rows[k].is_second, static_cast<int>(k) >= memory.first_rows);
  }
  EXPECT_EQ(program.look_at_rows(relative, memory), GrowthLook::Apart);
  EXPECT_EQ(program.look_at_features(relative, memory, counts), GrowthLook::Apart);
  memory = {};
  EXPECT_EQ(program.look_at_features(relative, memory, counts), GrowthLook::Open);
  EXPECT_EQ(program.decide_by_pivots(relative, memory, counts), Verdict::Apart);
  EXPECT_EQ(program.look_at_features(relative, memory, counts), GrowthLook::Apart);
}

TEST(GrowthProgram, OfOneOriginHasNothingToGoOnFrom) {
  const ConvexBody cube = test::box({1, 1, 1});
  const ProofBody proofs(cube);
  const GrowthProgram program(proofs, proofs);
  GrowthMemory memory;
  GrowthCounts counts;
  RelativePose relative;
  ASSERT_TRUE(relative_pose(program.first(), program.second(), {}, relative));
  EXPECT_EQ(program.optimum(relative, memory, counts).upper, 0);
  EXPECT_FALSE(memory.has_basis());
  EXPECT_EQ(program.decide_by_pivots(relative, memory, counts), Verdict::Meet);
  EXPECT_FALSE(memory.has_basis());
  EXPECT_EQ(program.look_at_features(relative, memory, counts), GrowthLook::Open);
}

}  // namespace
}  // namespace carpus::convex
