// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Trees of volumes and the scene on whole numbers, where nothing is rounded: every verdict must be
// that of all separating axes in integers, for bodies that touch or lie within each other too.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "convex/pair_query.hpp"
#include "core/rng.hpp"
#include "oracles/sample_bodies.hpp"
#include "oracles/separating_axes.hpp"
#include "survey/methods.hpp"
#include "survey/scene.hpp"

namespace carpus {
namespace {

using convex::ConvexBody;
using convex::PairPose;
using convex::PairQuery;
using convex::Verdict;
using survey::Method;

constexpr std::array<std::string_view, 6> kTrees{"aabb_tree",   "obb_tree",    "quick_cd_6",
                                                 "quick_cd_14", "quick_cd_18", "quick_cd_26"};

struct Tally {
  std::array<int, 3> seen{};  ///< overlapping, touching, apart
  int nested = 0;
  int wrong = 0;
};

/// A body within the other's box, small enough to fit in.
ConvexPolytope small_body(Rng& rng) {
  ConvexPolytope body = oracles::special_solid(rng.below(2));
  for (Vec3& v : body.vertices) v = v * 0.25;
  for (Plane& p : body.planes) p.offset *= 0.25;
  return body;
}

/// In units of a quarter, so that small bodies are whole too.
oracles::Body<long long> in_quarters(const ConvexPolytope& body, const Mat3& r, const Vec3& t) {
  ConvexPolytope scaled = body;
  for (Vec3& v : scaled.vertices) v = v * 4;
  return oracles::body_of<long long>(scaled, r, t * 4);
}

void compare(std::uint64_t seed, Tally& tally) {
  Rng rng(seed);
  const ConvexBody first(oracles::integer_body(rng));
  const bool is_small = rng.below(3) == 0;
  const ConvexBody second(is_small ? small_body(rng) : oracles::integer_body(rng));
  std::vector<std::unique_ptr<PairQuery>> queries;
  for (const std::string_view name : kTrees) {
    queries.push_back(survey::find_method(name)->make(first, second));
    queries.push_back(survey::find_method(name)->make(second, first));
  }
  const auto exact_first = in_quarters(first.polytope(), Mat3::identity(), {});
  for (int step = 0; step < 8; ++step) {  // the state of one answer starts the next
    PairPose pose;
    pose.rotation = oracles::axis_rotation(rng);
    const auto c = [&] { return static_cast<double>(rng.below(is_small ? 20 : 30)) - 12; };
    pose.translation = Vec3{c(), c(), c()} * (is_small ? 0.5 : 1);
    const auto exact_second = in_quarters(second.polytope(), pose.rotation, pose.translation);
    const long long gap = oracles::separation(exact_first, exact_second);
    const Mat3 back = pose.rotation.transposed();
    const PairPose swapped{back, -(back * pose.translation)};
    const Verdict expected = gap <= 0 ? Verdict::Meet : Verdict::Apart;
    for (std::size_t k = 0; k < queries.size(); ++k) {
      if (step % 3 == 0) queries[k]->forget();
      tally.wrong += queries[k]->meets(k % 2 == 0 ? pose : swapped) == expected ? 0 : 1;
    }
    ++tally.seen[static_cast<std::size_t>(gap + 1)];
    tally.nested += is_small && gap < 0 ? 1 : 0;
  }
}

TEST(VolumesOracle, TreesAgreeWithIntegerArithmeticOnTouchingNestedAndSeparatedPairs) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 300; ++seed) compare(seed, tally);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.seen[0], 200);
  EXPECT_GT(tally.seen[1], 30);
  EXPECT_GT(tally.seen[2], 200);
  EXPECT_GT(tally.nested, 50);
}

TEST(VolumesOracle, EveryBroadPhaseKeepsTheVerdictsOfEveryMethod) {
  Rng rng(9);
  std::vector<ConvexBody> bodies;
  for (int i = 0; i < 7; ++i) bodies.emplace_back(oracles::integer_body(rng));
  for (const Method& method : survey::all_methods()) {
    survey::Scene all(bodies, method, survey::BroadPhase::None);
    survey::Scene boxes(bodies, method, survey::BroadPhase::AllBoxes);
    survey::Scene sweep(bodies, method, survey::BroadPhase::SweepAndPrune);
    std::vector<survey::BodyPose> poses(bodies.size());
    std::size_t culled = 0;
    for (int tick = 0; tick < 30; ++tick) {
      for (survey::BodyPose& pose : poses) {
        const auto c = [&] { return static_cast<double>(rng.below(40)) - 20; };
        pose = {oracles::axis_rotation(rng), {c(), c(), c()}};
      }
      all.update(poses);
      culled += all.pair_count() - boxes.update(poses).queries;
      sweep.update(poses);
      for (std::size_t p = 0; p < all.pair_count(); ++p) {
        ASSERT_EQ(all.verdicts()[p], boxes.verdicts()[p]) << method.name;
        ASSERT_EQ(all.verdicts()[p], sweep.verdicts()[p]) << method.name;
      }
    }
    EXPECT_GT(culled, 100U) << method.name;
  }
}

}  // namespace
}  // namespace carpus
