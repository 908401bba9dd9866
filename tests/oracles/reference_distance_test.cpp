// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "oracles/reference_distance.hpp"

#include <gtest/gtest.h>

#include "oracles/exact_meet.hpp"
#include "oracles/pair_generator.hpp"

namespace carpus::oracles {
namespace {

TEST(ReferenceDistance, BoundsProveEachOtherAndDepthIsTheLeastOverAllAxes) {
  int apart = 0;
  int meeting = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    PairGenerator pairs(seed);
    ExactMeet exact(pairs.first.vertices, pairs.second.vertices);
    const auto first = body_of<long double>(pairs.first, Mat3::identity(), {});
    double reach = pairs.size_mm;
    for (const Vec3& v : pairs.first.vertices) reach = std::max(reach, length(v));
    for (int i = 0; i < 4; ++i) {
      const Placement p = pairs.next();
      const auto answer = exact.query(p.rotation, p.translation);
      if (p.is_near || answer.needed_integers) continue;
      const auto second = body_of<long double>(pairs.second, p.rotation, p.translation);
      const double tolerance = 1e-12 * (reach + length(p.translation));
      if (answer.meet) {
        const long double depth = reference_depth(first, pairs.first, second, pairs.second);
        EXPECT_NEAR(static_cast<double>(depth + separation(first, second)), 0, tolerance) << seed;
        ++meeting;
      } else {
        const DistanceBounds d = reference_distance(first, second);
        EXPECT_GT(d.lower_mm, 0);
        EXPECT_NEAR(static_cast<double>(d.upper_mm - d.lower_mm), 0, tolerance) << seed;
        ++apart;
      }
    }
  }
  EXPECT_GT(apart, 30);
  EXPECT_GT(meeting, 15);
}

}  // namespace
}  // namespace carpus::oracles
