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

TEST(MetalInBeam, EmptyHandsShowNothing) {
  EXPECT_TRUE(metal_in_beam(simulation::Snapshot{}).empty());
}

}  // namespace
}  // namespace carpus::session
