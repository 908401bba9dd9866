// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The library in ten lines; README.md shows the same.
#include <gtest/gtest.h>

#include <vector>

#include "convex/pair_query.hpp"
#include "hull/fast_hull.hpp"
#include "survey/methods.hpp"
#include "survey/motion/contact_interval.hpp"

namespace {

using namespace carpus;  // NOLINT(google-build-using-namespace)

TEST(Example, TellsHowFarTwoPyramidsAreApartAndWhenTheyWillMeet) {
  const std::vector<Vec3> points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};  // mm
  const convex::ConvexBody pyramid(hull::build_fast_hull(points).polytope);
  const convex::PairPose beside{Mat3::identity(), {5, 0, 0}};
  const auto query = survey::find_method("closest_active_set")->make(pyramid, pyramid);
  EXPECT_EQ(query->meets(beside), convex::Verdict::Apart);
  EXPECT_NEAR(query->closest(beside)->distance_mm, 3, 1e-12);  // NOLINT
  survey::ContactIntervalQuery motion(pyramid, pyramid);
  const survey::ContactInterval way = motion.query(beside, {-6, 0, 0});  // mm/s
  EXPECT_EQ(way.outcome, survey::MotionOutcome::WillMeet);
  EXPECT_NEAR(way.t_min_s, 0.5, 1e-12);
}

}  // namespace
