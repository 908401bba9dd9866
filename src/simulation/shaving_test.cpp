// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/shaving.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace carpus::simulation::detail {
namespace {

using cases::TissueKind;
using cases::TissuePiece;

/// A tuft; of the disc an ill one, a sound one, one of its rim and one of its own hole.
std::vector<TissuePiece> pieces() {
  std::vector<TissuePiece> made(5);
  made[0].patch = 1;
  for (std::size_t i = 1; i < made.size(); ++i) made[i].kind = TissueKind::Disc;
  made[2].is_ill = made[3].is_ill = made[4].is_ill = false;
  made[3].is_rim = true;
  made[4].is_gone = true;
  return made;
}

void cut_off(ShavingState& state, std::size_t i) {
  const std::vector<TissuePiece> all = pieces();
  for (int tick = 1; tick < ticks_to_cut(all[i].kind); ++tick) {
    ASSERT_FALSE(cut_piece(state, all, i)) << tick;
  }
  ASSERT_TRUE(cut_piece(state, all, i));
}

TEST(Shaving, BeforeAnythingIsDoneTheDiscsOwnHoleIsThereAndCountsForNothing) {
  const std::vector<TissuePiece> all = pieces();
  const ShavingState state = untouched(all);
  EXPECT_EQ(state.done.ill, 2);
  EXPECT_EQ(state.done.sound, 2);
  EXPECT_EQ(state.done.patches, 2);
  EXPECT_TRUE(is_gone(state, all, 4));
  EXPECT_EQ(left_share(state, all, 4), 0.0);
  EXPECT_EQ(left_share(state, all, 0), 1.0);
  EXPECT_TRUE(is_possible(state, all));
}

TEST(Shaving, APieceComesOffTickByTickAndIsCountedOnce) {
  const std::vector<TissuePiece> all = pieces();
  ShavingState state = untouched(all);
  state.done.ticks_since_cut = 7;
  state.done.seen_since = 7;
  for (int i = 0; i < ticks_to_cut(TissueKind::Synovium) / 2; ++i) {
    (void)cut_piece(state, all, 0);
  }
  EXPECT_NEAR(left_share(state, all, 0), 0.5, 0.01);
  EXPECT_EQ(state.done.ill_removed, 0);
  EXPECT_EQ(state.done.ticks_since_cut, 7U);
  while (!is_gone(state, all, 0)) (void)cut_piece(state, all, 0);
  EXPECT_EQ(state.done.ill_removed, 1);
  EXPECT_EQ(state.done.ticks_since_cut, 0U);
  EXPECT_EQ(state.done.seen_since, 0U) << "it is looked at anew";
  EXPECT_FALSE(cut_piece(state, all, 0)) << "it is gone";
  EXPECT_FALSE(cut_piece(state, all, 4)) << "of the disc's own hole";
  EXPECT_EQ(state.done.ill_removed, 1);
}

TEST(Shaving, APieceThatIsBittenOffGoesAtOnceHoweverMuchOfItWasLeft) {
  const std::vector<TissuePiece> all = pieces();
  ShavingState shaved = untouched(all);
  ShavingState bitten = untouched(all);
  for (const std::size_t i : {0, 1, 2, 3}) cut_off(shaved, i);
  (void)cut_piece(bitten, all, 1);  // a little of it is gone before
  bitten.done.ticks_since_cut = 7;
  for (const std::size_t i : {0, 1, 2, 3}) take_piece(bitten, all, i);
  EXPECT_EQ(bitten.cut_ticks, shaved.cut_ticks);
  EXPECT_EQ(bitten.done, shaved.done) << "whatever takes it, it is counted alike";
  take_piece(bitten, all, 3);
  take_piece(bitten, all, 4);
  EXPECT_EQ(bitten.done, shaved.done) << "what is gone is counted once";
  EXPECT_TRUE(is_possible(bitten, all));
}

TEST(Shaving, WhatWasToStayIsCountedApartAndTheRimOfItToo) {
  const std::vector<TissuePiece> all = pieces();
  ShavingState state = untouched(all);
  cut_off(state, 1);
  cut_off(state, 2);
  EXPECT_EQ(state.done.ill_removed, 1);
  EXPECT_EQ(state.done.sound_removed, 1);
  EXPECT_EQ(state.done.rim_removed, 0);
  cut_off(state, 3);
  EXPECT_EQ(state.done.sound_removed, 2);
  EXPECT_EQ(state.done.rim_removed, 1);
  EXPECT_TRUE(is_possible(state, all));
}

TEST(Shaving, AStateThatNoTickLeftIsRefused) {
  const std::vector<TissuePiece> all = pieces();
  ShavingState good = untouched(all);
  cut_off(good, 2);
  ASSERT_TRUE(is_possible(good, all));
  const std::vector<std::pair<const char*, std::function<void(ShavingState&)>>> tampered{
      {"cut more than whole", [](auto& s) { ++s.cut_ticks[2]; }},
      {"cut, and there are no such pieces", [](auto& s) { s.cut_ticks[5] = 1; }},
      {"the disc's own hole is closed", [](auto& s) { s.cut_ticks[4] = 0; }},
      {"fewer ill ones", [](auto& s) { --s.done.ill; }},
      {"more sound ones", [](auto& s) { ++s.done.sound; }},
      {"removed, and it is there", [](auto& s) { ++s.done.ill_removed; }},
      {"gone, and not counted", [](auto& s) { s.done.sound_removed = 0; }},
      {"of the rim, and it is there", [](auto& s) { ++s.done.rim_removed; }},
      {"patches that there are not", [](auto& s) { s.done.patches = cases::kMaxPatches + 1; }},
      {"turned farther than round", [](auto& s) { s.mouth_deg[1] = 181; }},
      {"turned nowhere",
       [](auto& s) { s.mouth_deg[0] = std::numeric_limits<double>::quiet_NaN(); }},
  };
  for (const auto& [what, change] : tampered) {
    ShavingState bad = good;
    change(bad);
    EXPECT_FALSE(is_possible(bad, all)) << what;
  }
}

TEST(Shaving, TheMouthLiesOnTheShaftsSideAndTurnsAboutIt) {
  const instruments::Mouth mouth{1.3, 1.0};
  const auto at = [&](double deg) {
    return mouth_place(mouth, 1.0, {10, 0, 0}, {1, 0, 0}, deg, {0, 0, 1});
  };
  EXPECT_NEAR(distance(at(0).at, {11.3, 0, 1}), 0, 1e-9) << "towards what is level";
  EXPECT_NEAR(distance(at(0).towards, {0, 0, 1}), 0, 1e-9);
  EXPECT_NEAR(distance(at(90).towards, {0, -1, 0}), 0, 1e-6) << "right-handed about the shaft";
  EXPECT_NEAR(distance(at(180).at, {11.3, 0, -1}), 0, 1e-6);
  EXPECT_NEAR(distance(at(-180).at, at(180).at), 0, 1e-6);
  for (double deg = -180; deg <= 180; deg += 15) {
    EXPECT_NEAR(length(at(deg).towards), 1, 1e-9);
    EXPECT_NEAR(at(deg).towards.x, 0, 1e-9) << "across the shaft";
  }
}

TEST(Shaving, OnlyWhatLiesBeforeTheMouthIsDrawnIn) {
  const MouthPlace mouth{{0, 0, 0}, {0, 0, 1}};
  const Vec3 down{0, 0, -1};
  // A tuft 1 mm high and 0.4 mm thick that hangs from above.
  const auto far = [&](const Vec3& base) { return before_mouth_mm(mouth, base, down, 1.0, 0.4); };
  EXPECT_NEAR(far({0, 0, 2}), 0.6, 1e-9) << "from its end, less its thickness";
  EXPECT_EQ(far({0, 0, 0.5}), 0.0) << "it lies in the mouth";
  EXPECT_NEAR(far({3, 0, 0.5}), 2.6, 1e-9) << "beside it";
  EXPECT_EQ(far({0, 0, -1}), kNotBefore) << "behind it";
  EXPECT_NEAR(far({0, 0, -0.5}), 0.1, 1e-9) << "a little behind its plane it is drawn in still";
  EXPECT_NEAR(before_mouth_mm(mouth, {0, 0, 1}, down, 0.0, 0.4), 0.6, 1e-9) << "flat";
}

}  // namespace
}  // namespace carpus::simulation::detail
