// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/tissue_bending.hpp"

#include <gtest/gtest.h>

#include <array>

#include "fluoroscopy/bone_phantom_test_support.hpp"

namespace carpus::fluoroscopy {
namespace {

using BodyPose = Pose<frame::Patient, frame::Bone>;

/// A hand of two bones above the origin, a forearm of one below it.
TissueBending two_segments() {
  const test::Phantom p = test::make_phantom(
      61, 1.0, {test::ball({0, 0, 20}, 5), test::ball({8, 0, 20}, 3), test::ball({0, 0, -20}, 5)},
      1000, test::ball({0, 0, 0}, 28), 50);
  const std::array<BodyLabel, 3> bodies{{{1, 0}, {2, 0}, {3, 1}}};
  return {p.labels.view(), bodies};
}

const BodyPose kTurned{rotation_about({0, 1, 0}, 0.8), {}};

TEST(TissueBending, CarriesAllTissueWhereAllBodiesMoveAsOne) {
  const TissueBending bending = two_segments();
  const std::array<BodyPose, 3> poses{kTurned, kTurned, kTurned};
  const BentTissue tissue(bending, poses);
  EXPECT_TRUE(tissue.is_rigid());
  const Vec3 scanned{3, -7, 11};
  EXPECT_LT(distance(tissue.source_of(kTurned * Point<frame::Bone>{scanned}), scanned), 1e-12);
}

TEST(TissueBending, GoesWithTheBodyThatItTouches) {
  const TissueBending bending = two_segments();
  const std::array<BodyPose, 3> poses{BodyPose{}, BodyPose{}, kTurned};
  const BentTissue tissue(bending, poses);
  EXPECT_FALSE(tissue.is_rigid());
  EXPECT_LT(distance(tissue.source_of({{0, 5.5, 20}}), {0, 5.5, 20}), 1e-9);
  const Vec3 at_forearm{0, 5.5, -20};
  EXPECT_LT(distance(tissue.source_of(kTurned * Point<frame::Bone>{at_forearm}), at_forearm), 1e-9);
}

TEST(TissueBending, TurnsHalfWayBetweenSegmentsAndKeepsDistancesToTheirAxis) {
  const TissueBending bending = two_segments();
  const std::array<BodyPose, 3> poses{BodyPose{}, BodyPose{}, kTurned};
  const BentTissue tissue(bending, poses);
  // By symmetry: the plane half way between forearm as turned and hand.
  const Vec3 half_way = rotation_about({0, 1, 0}, 0.4) * Vec3{0, 10, 0};
  const Vec3 source = tissue.source_of({half_way});
  EXPECT_NEAR(source.y, 10, 1e-9);
  EXPECT_LT(distance(source, {0, 10, 0}), 0.5);
  EXPECT_NEAR(length(tissue.source_of({{9, 4, 3}})), length({9, 4, 3}), 1e-9)
      << "any blend is a turn about the same axis";
}

TEST(TissueBending, CountsASegmentOnceHoweverManyBodiesItHas) {
  const TissueBending bending = two_segments();
  const test::Phantom p =
      test::make_phantom(61, 1.0, {test::ball({0, 0, 20}, 5), test::ball({0, 0, -20}, 5)}, 1000,
                         test::ball({0, 0, 0}, 28), 50);
  const std::array<BodyLabel, 2> one_each{{{1, 0}, {2, 1}}};
  const TissueBending fewer(p.labels.view(), one_each);
  const std::array<BodyPose, 3> poses{BodyPose{}, BodyPose{}, kTurned};
  const std::array<BodyPose, 2> fewer_poses{BodyPose{}, kTurned};
  const Point<frame::Patient> left{{-6, 0, 1}};  // away from the hand's second bone
  EXPECT_LT(distance(BentTissue(bending, poses).source_of(left),
                     BentTissue(fewer, fewer_poses).source_of(left)),
            1e-9);
}

TEST(TissueBending, NamesTheNearestBodyAndNoneWhereThereIsNone) {
  EXPECT_EQ(two_segments().nearest_body({12, 0, 20}), std::size_t{1});
  EXPECT_EQ(two_segments().nearest_body({0, 0, -300}), std::size_t{2});
  const Grid<std::uint8_t> empty(GridGeometry{{4, 4, 4}, {1, 1, 1}, {}, {}});
  const std::array<BodyLabel, 1> bodies{{{1, 0}}};
  const TissueBending none(empty.view(), bodies);
  EXPECT_EQ(none.nearest_body({0, 0, 0}), std::nullopt);
  const std::array<BodyPose, 1> moved{kTurned};
  EXPECT_TRUE(BentTissue(none, moved).is_rigid());
}

}  // namespace
}  // namespace carpus::fluoroscopy
