// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// IVRI-CD against all separating axes, and where it is wrong.
#include "survey/ivri/ivri_cd.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "oracles/sample_bodies.hpp"
#include "oracles/separating_axes.hpp"

namespace carpus {
namespace {

using convex::PairPose;
using survey::IvriCd;
using survey::IvriStatus;

/// Counts of overlapping, touching and separate pairs, and of wrong answers.
struct Tally {
  std::array<int, 3> seen{};
  int wrong = 0;
  std::uint64_t pivot_limits = 0;
};

void compare_integer_pairs(std::uint64_t seed, Tally& tally) {
  Rng rng(seed);
  const ConvexPolytope first = oracles::integer_body(rng);
  const ConvexPolytope second = oracles::integer_body(rng);
  IvriCd ivri(first.vertices, second.vertices);
  const auto exact_first = oracles::body_of<long long>(first, Mat3::identity(), {});
  for (int step = 0; step < 12; ++step) {  // the state of one answer starts the next
    PairPose pose;
    if (step % 3 == 0) ivri.forget();
    pose.rotation = oracles::axis_rotation(rng);
    const auto c = [&] { return static_cast<double>(rng.below(30)) - 12; };
    pose.translation = {c(), c(), c()};
    const auto exact_second = oracles::body_of<long long>(second, pose.rotation, pose.translation);
    const long long gap = oracles::separation(exact_first, exact_second);
    const IvriStatus expected = gap <= 0 ? IvriStatus::Meet : IvriStatus::Apart;
    tally.wrong += ivri.query(pose).status == expected ? 0 : 1;
    ++tally.seen[static_cast<std::size_t>(gap + 1)];
  }
  tally.pivot_limits += ivri.statistics().pivot_limits;
}

TEST(IvriOracle, AgreesWithIntegerArithmeticOnTouchingNestedAndSeparatedPairs) {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) compare_integer_pairs(seed, tally);
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_EQ(tally.pivot_limits, 0U);
  EXPECT_GT(tally.seen[0], 1000);
  EXPECT_GT(tally.seen[1], 200);
  EXPECT_GT(tally.seen[2], 1000);
}

/// Two long plates that overlap aslant, their large faces nearly parallel to the program's line u.
struct Plates {
  ConvexPolytope low;
  ConvexPolytope high;
  Vec3 up;           ///< across the plates
  double thickness;  ///< half of it [mm]
};

Plates plates(Rng& rng) {
  const Mat3 turn = rotation_about(
      normalized_or({rng.normal(), rng.normal(), rng.normal()}, {1, 0, 0}), rng.uniform(0, 6));
  const double half = rng.uniform(0.05, 1);
  const double tilt = rng.uniform() * 1e-3;
  const double shift = rng.uniform(20, 60);
  std::vector<Vec3> low;
  std::vector<Vec3> high;
  for (std::uint64_t i = 0; i < 8; ++i) {
    const Vec3 corner{(i & 1U) != 0 ? 50.0 : -50.0, (i & 2U) != 0 ? 20.0 : -20.0,
                      (i & 4U) != 0 ? half : -half};
    low.push_back(turn * (corner + Vec3{0, 0, tilt * rng.uniform()}));
    high.push_back(turn * (corner + Vec3{shift, 1, 2 * half + tilt * rng.uniform()}));
  }
  return {oracles::hull_of(low), oracles::hull_of(high), turn * Vec3{0, 0, 1}, half};
}

TEST(IvriOracle, IsRightBeyondEpsilonWhereContactIsNearlyParallelToItsLine) {
  int wrong = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    Rng rng(seed);
    const Plates p = plates(rng);
    const auto oracle_low = oracles::body_of<long double>(p.low, Mat3::identity(), {});
    double meet = -p.thickness;
    double apart = 1;
    for (int i = 0; i < 55; ++i) {
      const double middle = (meet + apart) / 2;
      const auto high = oracles::body_of<long double>(p.high, Mat3::identity(), p.up * middle);
      (oracles::separation(oracle_low, high) <= 0 ? meet : apart) = middle;
    }
    IvriCd ivri(p.low.vertices, p.high.vertices);
    const auto is = [&](double height, IvriStatus expected) {
      return ivri.query({Mat3::identity(), p.up * height}).status == expected ? 0 : 1;
    };
    for (const double depth : {1e-12, 1e-10, 1e-6}) wrong += is(meet - depth, IvriStatus::Meet);
    wrong += is(apart + 1e-8, IvriStatus::Apart);
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace carpus
