// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "survey/volumes/moved_box.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/rng.hpp"

namespace carpus::survey {
namespace {

using AnyPose = Pose<frame::Wrist, frame::Bone>;

AnyPose random_pose(Rng& rng, double range) {
  return {rotation_from_quaternion(rng.normal(), rng.normal(), rng.normal(), rng.normal()),
          {rng.uniform(-range, range), rng.uniform(-range, range), rng.uniform(-range, range)}};
}

std::vector<Vec3> ellipsoid(Rng& rng, std::size_t count) {
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 p = normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0});
    points.push_back({3 + 12 * p.x, -20 + 6 * p.y, 5 * p.z});
  }
  return points;
}

bool contains(const Aabb& box, const AnyPose& pose, const Vec3& p) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3& row = pose.rotation.rows[axis];
    const long double at = static_cast<long double>(row.x) * p.x +
                           static_cast<long double>(row.y) * p.y +
                           static_cast<long double>(row.z) * p.z + pose.translation[axis];
    if (at < box.low[axis] || at > box.high[axis]) return false;
  }
  return true;
}

TEST(MovedBox, ContainsEveryMovedPointAndIsNearlyTight) {
  Rng rng(1);
  double wide = 0;
  double exact_wide = 0;
  for (int set = 0; set < 20; ++set) {
    const std::vector<Vec3> points = ellipsoid(rng, 4 + 20 * rng.below(10));
    const MovedBox moved(points);
    for (int i = 0; i < 50; ++i) {
      const AnyPose pose = random_pose(rng, i % 2 == 0 ? 100 : 1e9);
      const Aabb box = moved.in(pose);
      Aabb exact;
      for (const Vec3& p : points) {
        ASSERT_TRUE(contains(box, pose, p));
        exact.include(pose.rotation * p + pose.translation);
      }
      wide += box.extent().x;
      exact_wide += exact.extent().x;
    }
  }
  EXPECT_LT(wide, 1.1 * exact_wide);
}

TEST(MovedBox, IsTheBoxItselfAtRestAndGrowsByTheMargin) {
  const std::vector<Vec3> points{{1, 2, 3}, {4, 1, 9}, {0, 0, 5}, {2, 8, 4}};
  const Aabb box = MovedBox(points).in(AnyPose{});
  EXPECT_NEAR(distance(box.low, {0, 0, 3}), 0, 1e-12);
  EXPECT_NEAR(distance(box.high, {4, 8, 9}), 0, 1e-12);
  const Aabb grown = MovedBox(points).in(AnyPose{}, 0.5);
  EXPECT_NEAR(distance(grown.high, {4.5, 8.5, 9.5}), 0, 1e-12);
}

TEST(MovedBox, IsNotANumberWhereThePoseIsNot) {
  const std::vector<Vec3> points{{1, 2, 3}, {4, 1, 9}};
  AnyPose pose;
  pose.translation.x = std::numeric_limits<double>::quiet_NaN();
  const Aabb box = MovedBox(points).in(pose);
  EXPECT_NE(box.low.x, box.low.x);
}

}  // namespace
}  // namespace carpus::survey
