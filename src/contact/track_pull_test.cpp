// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/track_pull.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/amount_test_support.hpp"
#include "fields/cut_tissue.hpp"
#include "fields/distance_field.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using carpus::test::amount;
using fields::CutTissue;

constexpr double kRadius = 0.57;

const std::vector<fields::ContactField>& block() {
  static const std::vector<fields::ContactField> kBlock = [] {
    const TriangleMesh mesh = fields::test::box({7, 7, 7});
    return std::vector<fields::ContactField>{
        {fields::build_distance_field(mesh, {.spacing_mm = 0.4, .band_mm = 4}), mesh}};
  }();
  return kBlock;
}
const InstrumentShape& wire() {
  static const InstrumentShape kWire(ConeTipShape{kRadius, 1.5, 40});
  return kWire;
}
TrackPull pull_at(const CutTissue& tissue, const Vec3& tip, const Vec3& shaft) {
  return track_pull(tissue.field(0), {tip}, {shaft}, kRadius);
}

TEST(TrackPull, IsNothingInUntouchedBoneToTheBit) {
  CutTissue tissue(block());
  EXPECT_EQ(pull_at(tissue, {1, 2, 3}, {0, 0, 1}).strength, 0);
  (void)tissue.remove(0, SweptTool::bar({-5, -5, -5}, 1, {-5, -5, 9}, 1));
  const TrackPull pull = pull_at(tissue, {2, 2, 3}, {0, 0, 1});
  EXPECT_EQ(pull.strength, 0);
  EXPECT_EQ(pull.direction.v, Vec3{});
}

TEST(TrackPull, IsNothingForATipInItsOwnHoleToTheBit) {
  Rng rng(1);
  for (int i = 0; i < amount(20, 100, 2000); ++i) {
    CutTissue tissue(block());
    const Mat3 turn = fields::test::turned_to(fields::test::random_direction(rng));
    const Vec3 tip = fields::test::random_shift(rng, 2);
    (void)tissue.remove(0, SweptTool::whole(wire(), {turn, tip}).widened(0.1));
    ASSERT_TRUE(tissue.field(0).is_cut());
    ASSERT_EQ(pull_at(tissue, tip, turn.column(2)).strength, 0);
  }
}

TEST(TrackPull, PointsIntoTheTrackBesideItAndGrowsTowardsIt) {
  Rng rng(2);
  for (int i = 0; i < amount(10, 40, 1000); ++i) {
    CutTissue tissue(block());
    const Mat3 turn = fields::test::turned_to(fields::test::random_direction(rng));
    const Vec3 shaft = turn.column(2);
    const Vec3 side = turn.column(0);
    (void)tissue.remove(0, SweptTool::whole(wire(), {turn, shaft * -4.0}, 1));
    double last = 0;
    for (const double apart : {1.3, 1.1, 0.9, 0.7}) {
      const TrackPull pull = pull_at(tissue, side * -apart, shaft);
      ASSERT_GE(pull.strength, last);
      ASSERT_LE(pull.strength, 1);
      ASSERT_NEAR(dot(pull.direction.v, shaft), 0, 1e-12);
      if (pull.strength > 0.05) {
        ASSERT_GT(dot(pull.direction.v, side), 0.9);
      }
      last = pull.strength;
    }
    ASSERT_GT(last, 0.25);
    ASSERT_LT(pull_at(tissue, {0, 0, 0}, shaft).strength, 0.15);  // in its middle
  }
}

TEST(TrackPull, IsNothingBetweenTwoTracksAlike) {
  CutTissue tissue(block());
  for (const double x : {-0.8, 0.8}) {
    (void)tissue.remove(0, SweptTool::bar({x, 0, -5}, kRadius, {x, 0, 9}, kRadius));
  }
  EXPECT_LT(pull_at(tissue, {0, 0, 0}, {0, 0, 1}).strength, 1e-3);
  EXPECT_GT(pull_at(tissue, {0.3, 0, 0}, {0, 0, 1}).strength, 0.02);
}

}  // namespace
}  // namespace carpus::contact
