// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "convex/bodies_test_support.hpp"
#include "convex/exact_meeting.hpp"
#include "core/allocation_test_support.hpp"
#include "core/rng.hpp"

namespace carpus::convex {
namespace {

Verdict exact_verdict(const ConvexBody& first, const ConvexBody& second, const PairPose& pose) {
  return exactly_meet({&first, Mat3::identity(), {}}, {&second, pose.rotation, pose.translation},
                      {})
      .verdict;
}

PairPose moved(const PairPose& pose, Rng& rng, double step_mm, double angle_rad) {
  return {rotation_about(test::random_direction(rng), rng.uniform(-angle_rad, angle_rad)) *
              pose.rotation,
          pose.translation + test::random_direction(rng) * rng.uniform(0, step_mm)};
}

TEST(Growth, StaysExactAlongTrajectoriesOfBoneLikeBodies) {
  Rng rng(1);
  for (const int points : {30, 400}) {
    const ConvexBody first = test::pebble(rng, points);
    const ConvexBody second = test::pebble(rng, points);
    GrowthQuery warm(first, second);
    GrowthQuery cold(first, second);
    int meets = 0;
    PairPose pose{Mat3::identity(), {13, 3, -4}};
    for (int tick = 0; tick < 1500; ++tick) {
      const bool is_jump = tick % 50 == 0;
      pose = moved(pose, rng, is_jump ? 3 : 0.05, is_jump ? 0.3 : 0.002);
      pose.translation *= length(pose.translation) > 20 ? 0.8 : 1.0;
      const Verdict verdict = warm.meets(pose);
      cold.forget();
      ASSERT_EQ(verdict, cold.meets(pose)) << tick;
      if (tick % 7 == 0) {
        ASSERT_EQ(verdict, exact_verdict(first, second, pose)) << tick;
      }
      meets += verdict == Verdict::Meet ? 1 : 0;
    }
    EXPECT_GT(meets, 50);
    EXPECT_LT(meets, 1450);
    const GrowthCounts& counts = warm.counts();
    EXPECT_EQ(counts.queries, 1500U);
    EXPECT_EQ(counts.pivot_limits, 0U);
    EXPECT_GT(counts.by_last_proof, 1200U);
    EXPECT_GT(counts.by_features, 0U);
    EXPECT_LT(counts.pivots, 40U);
  }
}

TEST(Growth, GivesTheSameVerdictForSwappedBodiesAndMovedFrames) {
  Rng rng(2);
  for (int i = 0; i < 300; ++i) {
    const ConvexBody first = test::pebble(rng, 40);
    const ConvexBody second = test::pebble(rng, 25);
    const PairPose pose{test::random_rotation(rng),
                        test::random_direction(rng) * rng.uniform(0, 25)};
    const Verdict verdict = GrowthQuery(first, second).meets(pose);
    const Mat3 back = pose.rotation.transposed();
    EXPECT_EQ(GrowthQuery(second, first).meets({back, -(back * pose.translation)}), verdict);
    const Mat3 turn = test::random_rotation(rng);
    const Vec3 shift{100, -50, 30};
    std::vector<Vec3> corners;
    for (const Vec3& v : first.vertices()) corners.push_back(turn * v + shift);
    const ConvexBody turned = test::body_of(corners);
    EXPECT_EQ(
        GrowthQuery(turned, second).meets({turn * pose.rotation, turn * pose.translation + shift}),
        verdict);
  }
}

TEST(Growth, HoldsOnSymmetricSolidsWithWarmChains) {
  std::vector<ConvexBody> solids;
  solids.push_back(test::box({2, 2, 2}));
  solids.push_back(test::octahedron(3));
  solids.push_back(test::prism(32, 2, 3));
  solids.push_back(test::lattice_ball(3));
  Rng rng(3);
  std::uint64_t exact = 0;
  std::uint64_t queries = 0;
  for (const ConvexBody& first : solids) {
    for (const ConvexBody& second : solids) {
      GrowthQuery query(first, second);
      for (int i = 0; i < 150; ++i) {  // concentric, aligned, half steps of the lattice
        const auto c = [&] { return (static_cast<double>(rng.below(25)) - 12) * 0.5; };
        const PairPose pose{Mat3::identity(), {c(), c(), c()}};
        ASSERT_EQ(query.meets(pose), exact_verdict(first, second, pose));
      }
      EXPECT_EQ(query.counts().pivot_limits, 0U);
      exact += query.counts().exact;
      queries += query.counts().queries;
    }
  }
  EXPECT_GT(exact, 0U);           // touching faces
  EXPECT_LT(exact * 3, queries);  // and little else
}

TEST(Growth, CountsHowQueriesWereDecided) {
  const ConvexBody cube = test::box({1, 1, 1});
  GrowthQuery query(cube, cube);
  EXPECT_EQ(query.meets({Mat3::identity(), {40, 0, 0}}), Verdict::Apart);
  EXPECT_EQ(query.counts().by_spheres, 1U);
  EXPECT_EQ(query.meets({Mat3::identity(), {40, 1, 0}}), Verdict::Apart);
  EXPECT_EQ(query.counts().by_last_proof, 1U);
  EXPECT_EQ(query.meets({Mat3::identity(), {0.5, 0, 0}}), Verdict::Meet);
  EXPECT_EQ(query.counts().cold_starts, 1U);
  EXPECT_EQ(query.meets({Mat3::identity(), {0.51, 0, 0}}), Verdict::Meet);
  EXPECT_EQ(query.counts().by_last_proof, 2U);
  EXPECT_EQ(query.meets({Mat3::identity(), {2, 0, 0}}), Verdict::Meet);
  EXPECT_EQ(query.counts().exact, 1U);
  EXPECT_EQ(query.counts().queries, 5U);
}

TEST(Growth, StartsColdNearFeaturesThatTouch) {
  Rng rng(23);
  std::uint64_t queries = 0;
  std::uint64_t pivots = 0;
  for (int k = 0; k < 200; ++k) {
    const ConvexBody first = test::pebble(rng, 400);
    const ConvexBody second = test::pebble(rng, 400);
    GrowthQuery query(first, second);
    PairPose pose{test::random_rotation(rng), test::random_direction(rng) * 40};
    const auto answer = query.growth(pose);
    ASSERT_TRUE(answer.has_value());
    // With the origins this much nearer the bodies all but touch.
    const Vec3 offset =
        pose.rotation * second.interior_point() + pose.translation - first.interior_point();
    pose.translation += offset * (1 / answer->growth * (1 + 1e-7) - 1);
    const std::uint64_t before = query.counts().pivots;
    query.forget();
    ASSERT_EQ(query.meets(pose), Verdict::Apart);
    pivots += query.counts().pivots - before;
    ++queries;
  }
  // From the line of origins alone there are twelve.
  EXPECT_LT(static_cast<double>(pivots) / static_cast<double>(queries), 6);
}

TEST(Growth, GivesTheFactorAtWhichBodiesTouch) {
  const ConvexBody cube = test::box({1, 1, 1});
  GrowthQuery query(cube, cube);
  for (const double distance : {0.0, 0.25, 1.0, 2.0, 3.0, 20.0}) {
    const auto answer = query.growth({Mat3::identity(), {distance, 0.1 * distance, 0}});
    ASSERT_TRUE(answer.has_value());
    EXPECT_NEAR(answer->growth, distance / 2, 1e-12);
    EXPECT_LE(answer->lower_bound, answer->upper_bound + 1e-12);
    EXPECT_NEAR(answer->point.x, distance / 2, 1e-11);
    if (distance > 2) {
      EXPECT_NEAR(answer->direction.x, 1, 1e-12);
    }
  }
  EXPECT_FALSE(query.growth({Mat3::identity(), {std::nan(""), 0, 0}}).has_value());
}

TEST(Growth, FindsAFactorThatGrownBodiesConfirm) {
  Rng rng(4);
  for (int i = 0; i < 40; ++i) {
    const ConvexBody first = test::pebble(rng, 60);
    const ConvexBody second = test::pebble(rng, 60);
    const PairPose pose{test::random_rotation(rng),
                        test::random_direction(rng) * rng.uniform(1, 30)};
    GrowthQuery query(first, second);
    const double growth = query.growth(pose)->growth;
    const auto grown = [](const ConvexBody& body, double factor) {
      std::vector<Vec3> corners;
      for (const Vec3& v : body.vertices()) {
        corners.push_back(body.interior_point() + (v - body.interior_point()) * factor);
      }
      return test::body_of(corners);
    };
    for (const double factor : {growth * (1 - 1e-9), growth * (1 + 1e-9)}) {
      const ConvexBody a = grown(first, factor);
      const ConvexBody b = grown(second, factor);
      EXPECT_EQ(exact_verdict(a, b, pose), factor > growth ? Verdict::Meet : Verdict::Apart);
    }
  }
}

TEST(Growth, DoesNotAllocateInAQuery) {
  Rng rng(5);
  const ConvexBody first = test::pebble(rng, 100);
  const ConvexBody cube = test::box({1, 1, 1});
  GrowthQuery pebbles(first, first);
  GrowthQuery cubes(cube, cube);
  carpus::test::start_counting_allocations();
  for (int i = 0; i < 200; ++i) {
    (void)pebbles.meets({rotation_about({0, 1, 0}, 0.03 * i), {0.15 * i, 0, 3}});
    (void)cubes.meets({Mat3::identity(), {2, 0.01 * i, 0}});
    (void)pebbles.growth({rotation_about({0, 1, 0}, 0.03 * i), {0.15 * i, 0, 3}});
  }
  EXPECT_EQ(carpus::test::stop_counting_allocations(), 0);
  EXPECT_GT(cubes.counts().exact, 100U);
}

}  // namespace
}  // namespace carpus::convex
