// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/punches.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace carpus::simulation::detail {
namespace {

const instruments::Bite kBite{1.0, 0.9, 2.0};

TEST(Punches, JawsCloseForwardOpenInReverseAndStayWhileNothingIsHeard) {
  EXPECT_TRUE(are_closed_after(false, true, Driver::Forward));
  EXPECT_FALSE(are_closed_after(true, true, Driver::Reverse));
  EXPECT_TRUE(are_closed_after(true, true, Driver::Off));
  EXPECT_FALSE(are_closed_after(false, true, Driver::Off));
  for (const Driver driver : {Driver::Off, Driver::Forward, Driver::Reverse}) {
    EXPECT_FALSE(are_closed_after(true, false, driver)) << "an empty hand has no jaws";
  }
}

TEST(Punches, WhatLiesNearestToTheMiddleOfTheJawsIsBitten) {
  const Vec3 middle = jaws_middle(kBite, {10, 0, 0}, {1, 0, 0});
  EXPECT_EQ(middle, Vec3(11, 0, 0));
  const auto far = [&](const Vec3& base, double height_mm) {
    return from_jaws_mm(middle, base, {0, 0, 1}, height_mm, 0.4);
  };
  EXPECT_NEAR(far({11, 0, -1}, 0.0), 0.6, 1e-9) << "flat, less its thickness";
  EXPECT_NEAR(far({11, 0, -2}, 1.0), 0.6, 1e-9) << "its end counts where it stands";
  EXPECT_EQ(far({11, 0, -1}, 3.0), 0.0) << "it stands between them";
  EXPECT_NEAR(far({11, 3, 0}, 0.0), 2.6, 1e-9) << "all round the shaft alike";
  EXPECT_NEAR(far({14, 0, 0}, 0.0), far({8, 0, 0}, 0.0), 1e-9) << "before and behind";
}

TEST(Punches, TheNearerOfTissueAndCartilageIsBittenAndLiningWhereNeitherIs) {
  constexpr double kFar = 1e9;
  EXPECT_EQ(bitten(kBite, 0.9, kFar, kFar), Bitten::Tissue);
  EXPECT_EQ(bitten(kBite, 0.91, kFar, kFar), Bitten::Nothing) << "out of reach";
  EXPECT_EQ(bitten(kBite, 0.5, 0.4, 0.0), Bitten::Cartilage);
  EXPECT_EQ(bitten(kBite, 0.4, 0.5, 0.0), Bitten::Tissue);
  EXPECT_EQ(bitten(kBite, 0.5, 0.5, 0.0), Bitten::Tissue) << "tissue stands on what it lies on";
  EXPECT_EQ(bitten(kBite, 0.5, 0.95, 0.0), Bitten::Tissue);
  EXPECT_EQ(bitten(kBite, 1.0, 0.9, 0.0), Bitten::Cartilage);
  EXPECT_EQ(bitten(kBite, 1.0, 1.0, 0.9), Bitten::Lining);
  EXPECT_EQ(bitten(kBite, 1.0, 1.0, 1.0), Bitten::Nothing);
  EXPECT_EQ(bitten(kBite, kFar, kFar, -2.0), Bitten::Lining) << "behind the wall's grid";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bitten(kBite, nan, nan, nan), Bitten::Nothing);
}

TEST(Punches, ABiteIsOfOneKindAndSeenOrNot) {
  procedure::PunchFacts done;
  count_bite(done, Bitten::Tissue, true);
  EXPECT_EQ(done, (procedure::PunchFacts{1, 0, 0, 0, 0}));
  count_bite(done, Bitten::Nothing, true);
  EXPECT_EQ(done, (procedure::PunchFacts{2, 0, 1, 0, 0}));
  count_bite(done, Bitten::Cartilage, false);
  EXPECT_EQ(done, (procedure::PunchFacts{3, 1, 1, 1, 0}));
  count_bite(done, Bitten::Lining, true);
  EXPECT_EQ(done, (procedure::PunchFacts{4, 1, 1, 1, 1}));
}

/// After nine bites on cartilage, one more than has a place.
PunchState scuffed() {
  PunchState state;
  for (std::size_t i = 0; i < kMaxScuffs + 1; ++i) {
    count_bite(state.done, Bitten::Cartilage, true);
    scuff(state, 1, {static_cast<double>(i), 0, 0});
  }
  return state;
}

TEST(Punches, CartilageIsScuffedWhereItWasBitten) {
  const PunchState state = scuffed();
  EXPECT_EQ(state.scuff_count, kMaxScuffs);
  EXPECT_EQ(state.scuffs[2], (ScuffView{1, {2, 0, 0}}));
  EXPECT_EQ(state.scuffs.back(), (ScuffView{1, {kMaxScuffs - 1, 0, 0}})) << "the first are kept";
  EXPECT_EQ(state.done.cartilage, kMaxScuffs + 1) << "all are counted";
  EXPECT_TRUE(is_possible(state, 2));
}

TEST(Punches, AStateThatNoTickLeftIsRefused) {
  const PunchState good = [] {
    PunchState state;
    count_bite(state.done, Bitten::Cartilage, false);
    scuff(state, 1, {3, 0, 0});
    count_bite(state.done, Bitten::Tissue, true);
    return state;
  }();
  ASSERT_TRUE(is_possible(good, 2));
  ASSERT_TRUE(is_possible(PunchState{}, 1));
  EXPECT_FALSE(is_possible(good, 1)) << "scuffed in a joint that is not there";
  const std::vector<std::pair<const char*, std::function<void(PunchState&)>>> tampered{
      {"more unseen than bitten", [](auto& s) { s.done.unseen = 3; }},
      {"more on nothing than bitten", [](auto& s) { s.done.empty = 2; }},
      {"more on nothing than can be counted", [](auto& s) { s.done.empty = 0xFFFFFFFF; }},
      {"a scuff that no bite left", [](auto& s) { s.done.cartilage = 0; }},
      {"a bite that left no scuff", [](auto& s) { s.scuff_count = 0; }},
      {"more scuffs than there is room for", [](auto& s) { s.scuff_count = 200; }},
      {"a place of none", [](auto& s) { s.scuffs[1].at_as_scanned.x = 1; }},
      {"far off", [](auto& s) { s.scuffs[0].at_as_scanned.x = 1e5; }},
      {"nowhere",
       [](auto& s) { s.scuffs[0].at_as_scanned.x = std::numeric_limits<double>::quiet_NaN(); }},
  };
  for (const auto& [what, change] : tampered) {
    PunchState bad = good;
    change(bad);
    EXPECT_FALSE(is_possible(bad, 2)) << what;
  }
}

}  // namespace
}  // namespace carpus::simulation::detail
