// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/virtual_coupling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/rng.hpp"
#include "core/units.hpp"

namespace carpus::haptics {
namespace {

/// A hand pushed about by a random muscle against the force that it feels, never faster than a hand
/// accelerates.
struct RandomHand {
  explicit RandomHand(std::uint64_t seed) : rng(seed) {}
  void step(const Vec3& force) {
    constexpr double kMassKg = 0.3;
    if (ticks++ % 40 == 0) {
      muscle = Vec3{rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(-8, 8)} - place * 1.0;
    }
    // N to mm per tick: 1 N on 1 kg is 1 m/s2, 1000 mm/s2.
    Vec3 change = (muscle + force) * (1000.0 / kMassKg * kTickSeconds * kTickSeconds);
    const double far = length(change);
    const double most = 0.99 * kMostSurpriseMm;
    if (far > most) change *= most / far;
    move += change;
    move *= 0.995;
    place += move;
  }
  Rng rng;
  int ticks = 0;
  Vec3 muscle;
  Vec3 move;
  Vec3 place;
};

TEST(VirtualCoupling, NeverGivesBackMoreThanWasPutInWhateverTheProxyDoes) {
  double most_given = -1e9;
  double most_put_in = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomHand hand(seed);
    Rng rng(seed + 1000);
    VirtualCoupling coupling;
    double work_on_hand = 0;  // N mm
    Vec3 wall{rng.uniform(-2, 2), 0, 0};
    Vec3 force;
    for (int tick = 0; tick < 20000; ++tick) {
      // A wall that also moves by itself, jumps, and sometimes is a line or a point that holds.
      if (tick % 700 == 0) wall.x = rng.uniform(-3, 3);
      wall.x += 0.01;
      Vec3 proxy = hand.place;
      if (seed % 3 == 0) proxy = wall;
      if (seed % 3 == 1) proxy.x = std::min(proxy.x, wall.x);
      if (seed % 3 == 2) proxy = {hand.place.x, wall.y, wall.z};
      force = coupling.force_n(proxy, hand.place, tick % 5000 < 2500 ? 40.0 : 3.0);
      const Vec3 before = hand.place;
      hand.step(force);
      work_on_hand += dot(force, hand.place - before);
      most_given = std::max(most_given, work_on_hand);
      most_put_in = std::min(most_put_in, work_on_hand);
      ASSERT_LE(work_on_hand, kFirstStoredNMm + 1e-9) << "seed " << seed << " tick " << tick;
    }
  }
  EXPECT_LT(most_put_in, -1.0) << "the hands did work against it";
}

TEST(VirtualCoupling, ASteadyPushIsAnsweredByTheSpring) {
  VirtualCoupling coupling;
  Vec3 force;
  double depth = 0;
  for (int tick = 0; tick < 400; ++tick) {
    depth = std::min(1.5, depth + 0.01);
    force = coupling.force_n({0, 0, 0}, {-depth, 0, 0}, kForceLimitN);
  }
  EXPECT_NEAR(force.x, 1.5 * kContactStiffnessNPerMm, 1e-9);
  EXPECT_GT(coupling.stored_n_mm(), 1.0);
}

/// What holds the tip moves by itself and uses up the account: a hand that is free again and then
/// presses on something must feel it.
TEST(VirtualCoupling, AnAccountThatIsUsedUpBeginsAnewInTheFree) {
  VirtualCoupling coupling;
  Vec3 hand{0, 0, 0};
  // Pushed back again and again by a proxy that goes ahead of it, without ever pressing.
  double proxy = 0;
  for (int tick = 0; tick < 4000; ++tick) {
    proxy = hand.x + 0.2;
    hand.x += 0.01;
    (void)coupling.force_n({proxy, 0, 0}, hand, kForceLimitN);
  }
  EXPECT_LT(coupling.stored_n_mm(), kUsedUpNMm);
  const double wall = hand.x;
  (void)coupling.force_n(hand, hand, kForceLimitN);
  coupling.let_go();
  Vec3 force;
  for (int tick = 0; tick < 400; ++tick) {
    hand.x = std::max(wall - 1.5, hand.x - 0.01);
    force = coupling.force_n({wall, 0, 0}, hand, kForceLimitN);
  }
  EXPECT_NEAR(force.x, 1.5 * kContactStiffnessNPerMm, 1e-9);
}

TEST(VirtualCoupling, IsNeverStrongerThanItsLimit) {
  VirtualCoupling coupling;
  Vec3 force;
  for (int tick = 0; tick < 4000; ++tick) {
    force = coupling.force_n({0, 0, 0}, {-0.02 * tick, 0, 0}, 7.0);
    ASSERT_LE(length(force), 7.0 + 1e-12);
  }
  EXPECT_NEAR(length(force), 7.0, 1e-12);
}

TEST(VirtualCoupling, AHandThatJumpsOrIsNotFiniteFeelsNothing) {
  VirtualCoupling coupling;
  for (int tick = 0; tick < 100; ++tick) {
    (void)coupling.force_n({0, 0, 0}, {-0.01 * tick, 0, 0}, kForceLimitN);
  }
  EXPECT_GT(coupling.stored_n_mm(), 0.1);
  EXPECT_EQ(coupling.force_n({0, 0, 0}, {-30, 0, 0}, kForceLimitN), Vec3{});
  EXPECT_LE(coupling.stored_n_mm(), kFirstStoredNMm);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(coupling.force_n({nan, 0, 0}, {-1, 0, 0}, kForceLimitN), Vec3{});
  EXPECT_EQ(coupling.take_faults(), 1U);
  EXPECT_EQ(coupling.take_faults(), 0U);
}

TEST(VirtualCoupling, AReleasedHandHasNothingInStoreButTheFirst) {
  VirtualCoupling coupling;
  for (int tick = 0; tick < 200; ++tick) {
    (void)coupling.force_n({0, 0, 0}, {-0.01 * tick, 0, 0}, kForceLimitN);
  }
  coupling.release({-2, 0, 0});
  EXPECT_LE(length(coupling.force_n({0, 0, 0}, {-2, 0, 0}, kForceLimitN)),
            kFirstStoredNMm / kMostSurpriseMm + 1e-12);
}

}  // namespace
}  // namespace carpus::haptics
