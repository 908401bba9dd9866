// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/contact_force.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace carpus::haptics {
namespace {

Vec3 arbitrary_vector() {
  const auto number = [] { return *rc::gen::inRange(-100000, 100000) * 0.01; };
  return {number(), number(), number()};
}

RC_GTEST_PROP(ForceLimiter, HoldsItsLimitAndTheDirection, ()) {
  ForceLimiter limiter;
  const Vec3 force = arbitrary_vector();
  const Vec3 limited = limiter.limited(force);
  RC_ASSERT(length(limited) <= kForceLimitN * (1 + 1e-12));
  RC_ASSERT(length(cross(limited, force)) <= 1e-9 * squared_length(force) + 1e-9);
  RC_ASSERT(limiter.faults() == 0U);
}

TEST(ForceLimiter, TurnsWhatIsNotFiniteIntoZeroAndCountsIt) {
  ForceLimiter limiter;
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& force : {Vec3{nan, 0, 0}, Vec3{0, inf, 0}, Vec3{1e200, 1e200, 0}}) {
    EXPECT_EQ(limiter.limited(force), Vec3{});
  }
  EXPECT_EQ(limiter.faults(), 3U);
}

RC_GTEST_PROP(ContactForce, PointsFromTheHandToTheProxy, ()) {
  const Vec3 proxy = arbitrary_vector();
  const Vec3 hand = arbitrary_vector();
  const Vec3 force = contact_force_n(proxy, hand, arbitrary_vector());
  RC_ASSERT(dot(force, proxy - hand) >= 0.0);
}

TEST(ContactForce, IsTheSpringForAHandAtRest) {
  const Vec3 force = contact_force_n({1, 0, 0}, {0, 0, 0}, {});
  EXPECT_DOUBLE_EQ(force.x, kContactStiffnessNPerMm);
  EXPECT_EQ(contact_force_n({1, 2, 3}, {1, 2, 3}, {5, 5, 5}), Vec3{});
}

}  // namespace
}  // namespace carpus::haptics
