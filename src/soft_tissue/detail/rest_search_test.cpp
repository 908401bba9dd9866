// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/rest_search.hpp"

#include <gtest/gtest.h>

namespace carpus::soft_tissue::detail {
namespace {

/// Three springs from fixed places to places on the hand, of rest length 0.
struct Springs {
  double stiffness = 3;
  std::array<Vec3, 3> on_hand{Vec3{10, 0, 0}, Vec3{0, 12, 0}, Vec3{0, 0, 9}};
  std::array<Vec3, 3> fixed;

  explicit Springs(const Mat3& turned, const Vec3& shifted) {
    for (std::size_t i = 0; i < 3; ++i) fixed[i] = turned * on_hand[i] + shifted;
  }
  [[nodiscard]] Load load(const Bodies& bodies) const {
    Load load;
    for (std::size_t b = 1; b < kHand; ++b) {
      load.energy += 0.5 * squared_length(bodies[b].shift);
      load.force[b] -= bodies[b].shift;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 at = bodies[kHand].at(on_hand[i]);
      load.energy += 0.5 * stiffness * squared_length(fixed[i] - at);
      load.push(bodies, kHand, at, (fixed[i] - at) * stiffness);
    }
    return load;
  }
  void add(const Bodies& bodies, Stiffness& s) const {
    for (std::size_t b = 1; b < kHand; ++b) s.add_shift(b, 1);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 at = bodies[kHand].at(on_hand[i]);
      const Vec3 arm = at - bodies[kHand].shift;
      for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        Unknowns change{};
        add_change(change, kHand, arm, way, 1);
        s.add_spring(change, stiffness);
      }
      s.add_turning(kHand, arm, (fixed[i] - at) * stiffness);
    }
  }
};

LeftOver search(const Springs& springs, Bodies& bodies) {
  return search_rest(
      bodies, {.force_n = 1e-9, .moment_nmm = 1e-8},
      [&](const Bodies& b) { return springs.load(b); },
      [&](const Bodies& b, Stiffness& s) { springs.add(b, s); });
}

TEST(RestSearch, FindsWhereTurnedAndShiftedSpringsLetABodyRest) {
  const Mat3 turned = rotation_about(normalized_or({1, 2, -1}, {}), 1.2);
  const Vec3 shifted{3, -4, 7};
  Bodies bodies;
  const LeftOver left = search(Springs(turned, shifted), bodies);
  EXPECT_LT(left.force_n, 1e-9);
  EXPECT_LT(left.moment_nmm, 1e-8);
  EXPECT_NEAR(left.energy, 0, 1e-12);
  EXPECT_LT(distance(bodies[kHand].shift, shifted), 1e-8);
  for (std::size_t r = 0; r < 3; ++r) {
    EXPECT_LT(distance(bodies[kHand].rotation.rows[r], turned.rows[r]), 1e-9);
  }
  // Steps of at most 0.7 mm lead there; Newton's rounds follow.
  EXPECT_LT(left.rounds, 80);
}

TEST(RestSearch, KnowsTheEnergyToTheSecondOrder) {
  const Springs springs(rotation_about({0, 0, 1}, 0.3), {1, 2, 3});
  Bodies bodies;
  bodies[kHand].rotation = rotation_about(normalized_or({1, 1, 0}, {}), 0.2);
  Stiffness stiffness;
  stiffness.clear();
  springs.add(bodies, stiffness);
  constexpr double kStep = 1e-4;
  const auto energy = [&](std::size_t i, double a, std::size_t j, double b) {
    Unknowns motion{};
    motion[i] += a;
    motion[j] += b;
    return springs.load(moved(bodies, motion)).energy;
  };
  const std::size_t hand = 6 * (kHand - 1);
  for (std::size_t i = hand; i < hand + 6; ++i) {
    for (std::size_t j = hand; j <= i; ++j) {
      const double measured = (energy(i, kStep, j, kStep) - energy(i, kStep, j, -kStep) -
                               energy(i, -kStep, j, kStep) + energy(i, -kStep, j, -kStep)) /
                              (4 * kStep * kStep);
      EXPECT_NEAR(stiffness.at(i, j), measured, 1e-3 * (1 + std::abs(measured))) << i << " " << j;
    }
  }
}

TEST(RestSearch, SaysWhatIsLeftWhereNothingHolds) {
  Bodies bodies;
  const LeftOver left = search_rest(
      bodies, {.most_rounds = 30},
      [](const Bodies& b) {
        Load load;
        load.force[kLunate] = {2, 0, 0};
        load.energy = -2 * b[kLunate].shift.x;
        return load;
      },
      [](const Bodies&, Stiffness&) {});
  EXPECT_NEAR(left.force_n, 2, 1e-12);
  EXPECT_EQ(left.rounds, 30);
  EXPECT_LE(bodies[kLunate].shift.x, 30 * 0.7 + 1e-9);  // no leap
}

}  // namespace
}  // namespace carpus::soft_tissue::detail
