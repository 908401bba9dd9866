// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/metal_in_beam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "instruments/instrument.hpp"

namespace carpus::session {
namespace {

simulation::Snapshot with(std::string_view instrument, std::uint8_t hand) {
  simulation::Snapshot snapshot;
  simulation::ItemView& item = snapshot.items[3];
  item.instrument = *instruments::instrument_of(instrument);
  item.hand = hand;
  item.tip_in_patient = {1, 2, 3};
  item.shaft_in_patient = {0, 1, 0};
  item.outer_shaft_in_patient = {0, 1, 0};
  item.length_mm = instruments::catalogue()[item.instrument].length_mm;
  item.bent_at_mm = item.length_mm;
  return snapshot;
}

TEST(MetalInBeam, RodsOfAnInstrumentLieAlongItsShaft) {
  const auto metal = metal_in_beam(with("guide_wire", 0));
  ASSERT_FALSE(metal.empty());
  double longest = 0;
  for (const auto& rod : metal) {
    for (const Vec3& end : {rod.start, rod.end}) {
      EXPECT_EQ(end.x, 1);
      EXPECT_EQ(end.z, 3);
      EXPECT_GE(end.y, 2 - 1e-9);
    }
    longest = std::max(longest, rod.end.y - rod.start.y);
  }
  EXPECT_GT(longest, 100) << "a guide wire is six inches long";
}

TEST(MetalInBeam, WhatHoldsAScrewIsGoneOnceItIsLetGo) {
  const auto held = metal_in_beam(with("acutrak_standard_1994_20", 0));
  const auto alone = metal_in_beam(with("acutrak_standard_1994_20", simulation::kNoHand));
  ASSERT_FALSE(alone.empty());
  EXPECT_GT(held.size(), alone.size()) << "the driver";
  for (const auto& rod : alone) {
    EXPECT_GE(std::min(rod.start.y, rod.end.y), 2 - 1e-9);
    EXPECT_LE(std::max(rod.start.y, rod.end.y), 2 + 20 + 1e-9) << "only the screw";
    EXPECT_EQ(rod.attenuation_per_mm, fluoroscopy::kTitaniumPerMm);
  }
}

TEST(MetalInBeam, ABentWireStandsOffBehindItsBendAndABrokenOneEndsThere) {
  simulation::Snapshot snapshot = with("guide_wire", simulation::kNoHand);
  simulation::ItemView& item = snapshot.items[3];
  item.body = 0;
  item.bent_at_mm = 20;
  item.outer_shaft_in_patient = {1, 0, 0};
  const auto bent = metal_in_beam(snapshot);
  ASSERT_EQ(bent.size(), 2U);
  EXPECT_EQ(bent[0].end, (Vec3{1, 22, 3}));
  EXPECT_NEAR(distance(bent[1].start, bent[0].end), 0.0, 1e-12) << "they meet";
  EXPECT_NEAR(distance(bent[1].end, {131, 22, 3}), 0.0, 1e-9);
  item.length_mm = item.bent_at_mm = 20;
  EXPECT_EQ(metal_in_beam(snapshot).size(), 1U);
}

TEST(MetalInBeam, EmptyHandsShowNothing) {
  EXPECT_TRUE(metal_in_beam(simulation::Snapshot{}).empty());
}

}  // namespace
}  // namespace carpus::session
