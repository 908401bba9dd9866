// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "convex/growth/rows_proof.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "convex/bodies_test_support.hpp"
#include "convex/exact_meeting.hpp"
#include "convex/polar_graph.hpp"
#include "core/rng.hpp"

namespace carpus::convex {
namespace {

RelativePose placed(const PolarGraph& first, const PolarGraph& second, const PairPose& pose) {
  RelativePose relative;
  EXPECT_TRUE(relative_pose(first, second, pose, relative));
  return relative;
}

/// Any faces whatever, the first body's first.
std::array<GrowthRow, 4> any_rows(const PolarGraph& first,
                                  const PolarGraph& second,
                                  int first_rows,
                                  Rng& rng) {
  std::array<GrowthRow, 4> rows;
  for (int i = 0; i < 4; ++i) {
    const bool is_second = i >= first_rows;
    const PolarGraph& graph = is_second ? second : first;
    const auto face = static_cast<std::uint32_t>(rng.below(graph.size()));
    rows[static_cast<std::size_t>(i)] = {graph.row(face).normal(), face, is_second};
  }
  return rows;
}

TEST(RowsProof, GivesTheBasisWeightsAndBoundUpToAFactor) {
  Rng rng(5);
  const ConvexBody first_body = test::pebble(rng, 40);
  const ConvexBody second_body = test::pebble(rng, 40);
  const PolarGraph first(first_body);
  const PolarGraph second(second_body);
  std::array<int, 4> usable{};
  for (int i = 0; i < 20000; ++i) {
    const int first_rows = 1 + i % 3;
    std::array<GrowthRow, 4> rows = any_rows(first, second, first_rows, rng);
    const RelativePose pose =
        placed(first, second,
               {test::random_rotation(rng), test::random_direction(rng) * rng.uniform(1, 40)});
    GrowthBasis basis(rows);
    basis.place(pose);
    if (!basis.solve()) continue;
    const double least = *std::min_element(basis.weights.begin(), basis.weights.end());
    const double largest = *std::max_element(basis.weights.begin(), basis.weights.end());
    SeparationProof proof;
    const bool found = separation_of_rows(rows, first_rows, pose, 1, 1, proof);
    if (std::abs(least) < 1e-9 || largest > 1e6) continue;  // either will do
    ASSERT_EQ(found, least > 0) << i;
    if (!found) continue;
    ++usable[static_cast<std::size_t>(first_rows)];
    const double factor = proof.first_reach + proof.second_reach;  // the sum of the weights
    Vec3 n;
    Vec3 m;
    for (std::size_t k = 0; k < 4; ++k) {
      (rows[k].is_second ? m : n) += rows[k].normal * basis.weights[k];
    }
    EXPECT_LT(length(proof.n * (1 / factor) - n), 1e-9 * (1 + length(n))) << i;
    EXPECT_LT(length(proof.m * (1 / factor) - m), 1e-9 * (1 + length(m))) << i;
    EXPECT_NEAR(dot(proof.n, pose.offset) / factor, basis.t, 1e-9 * (1 + std::abs(basis.t)));
    EXPECT_LT(length(pose.into_second(proof.n) + proof.m), 1e-9 * proof.size);
  }
  for (int k = 1; k <= 3; ++k) EXPECT_GT(usable[static_cast<std::size_t>(k)], 300) << k;
}

TEST(RowsProof, TellsAGapFromATouchAndFromAnOverlap) {
  const ConvexBody cube = test::box({1, 1, 1});
  const PolarGraph graph(cube);
  const auto face_along = [&](const Vec3& d) { return graph.top(d).face; };
  const auto row = [&](const Vec3& d, bool is_second) {
    return GrowthRow{graph.row(face_along(d)).normal(), face_along(d), is_second};
  };
  // The face of one and a corner of the other, whose diagonal stands on it.
  const Vec3 diagonal = normalized_or({1, 1, 1}, {});
  const Vec3 axis = normalized_or(cross(diagonal, {-1, 0, 0}), {});
  const Mat3 turn = rotation_about(axis, std::acos(dot(diagonal, Vec3{-1, 0, 0})));
  const std::array<GrowthRow, 4> rows{row({1, 0, 0}, false), row({1, 0, 0}, true),
                                      row({0, 1, 0}, true), row({0, 0, 1}, true)};
  const auto look = [&](double gap) {
    const PairPose pose{turn, {1 + std::sqrt(3.0) + gap, 0, 0}};
    const RelativePose relative = placed(graph, graph, pose);
    SeparationProof proof;
    EXPECT_TRUE(separation_of_rows(rows, 1, relative, graph.reach(), graph.reach(), proof));
    const bool holds = proof.holds(relative, graph.outer_radius_mm());
    EXPECT_TRUE(!holds || proof.may_hold(relative, graph.outer_radius_mm()));
    return holds ? 1 : (proof.may_hold(relative, graph.outer_radius_mm()) ? 0 : -1);
  };
  EXPECT_EQ(look(1), 1);
  EXPECT_EQ(look(1e-9), 1);
  EXPECT_EQ(look(1e-12), 1);
  EXPECT_EQ(look(0), 0);
  EXPECT_EQ(look(-1e-15), 0);
  EXPECT_EQ(look(-1e-9), -1);
  EXPECT_EQ(look(-0.5), -1);
}

TEST(RowsProof, NeverPartsBodiesThatMeet) {
  Rng rng(6);
  int proofs = 0;
  for (int i = 0; i < 3000; ++i) {
    const ConvexBody first_body = test::pebble(rng, 6);
    const ConvexBody second_body = test::pebble(rng, 6);
    const PolarGraph first(first_body);
    const PolarGraph second(second_body);
    const PairPose pose{test::random_rotation(rng),
                        test::random_direction(rng) * rng.uniform(5, 25)};
    const RelativePose relative = placed(first, second, pose);
    bool is_apart = false;
    for (int k = 0; k < 30; ++k) {
      const int first_rows = 1 + k % 3;
      SeparationProof proof;
      is_apart =
          is_apart || (separation_of_rows(any_rows(first, second, first_rows, rng), first_rows,
                                          relative, first.reach(), second.reach(), proof) &&
                       proof.holds(relative, second.outer_radius_mm()));
    }
    if (!is_apart) continue;
    ++proofs;
    ASSERT_EQ(exactly_meet({&first_body, Mat3::identity(), {}},
                           {&second_body, pose.rotation, pose.translation}, {})
                  .verdict,
              Verdict::Apart)
        << i;
  }
  EXPECT_GT(proofs, 300);
}

}  // namespace
}  // namespace carpus::convex
