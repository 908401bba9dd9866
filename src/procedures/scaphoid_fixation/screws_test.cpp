// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/screws.hpp"

#include <gtest/gtest.h>

#include "procedures/built_in.hpp"

namespace carpus::procedures::scaphoid_fixation {
namespace {

TEST(IdealScrew, IsTheLongestThatLeavesFourMillimetres) {
  const auto screws = screws_on(built_in().all().front()->tray);
  ASSERT_EQ(screws.size(), 16U);
  const auto ideal = [&](double measured) {
    const int place = ideal_screw(screws, measured);
    return place < 0 ? -1.0
                     : instruments::catalogue()[screws[static_cast<std::size_t>(place)]].length_mm;
  };
  EXPECT_EQ(ideal(28.0), 24.0);
  EXPECT_EQ(ideal(27.99), 22.5);
  EXPECT_EQ(ideal(16.0), -1.0);
  EXPECT_EQ(ideal(60.0), 30.0);
}

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
