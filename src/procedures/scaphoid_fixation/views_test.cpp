// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "procedures/scaphoid_fixation/views.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carpus::procedures::scaphoid_fixation {
namespace {

TEST(Views, AreRangesOfTheTwoAngles) {
  EXPECT_TRUE(shows(View::Pa, 0, 0));
  EXPECT_TRUE(shows(View::Pa, 180, 0)) << "the same contours from the other side";
  EXPECT_TRUE(shows(View::Lateral, -90, 0));
  EXPECT_TRUE(shows(View::PronatedOblique, 45, 0));
  EXPECT_FALSE(shows(View::PronatedOblique, -45, 0)) << "supinated";
  EXPECT_TRUE(shows(View::ProximalPole, 0, 30));
  EXPECT_FALSE(shows(View::ProximalPole, 90, 30));
  EXPECT_FALSE(shows(View::Pa, std::nan(""), 0));
}

}  // namespace
}  // namespace carpus::procedures::scaphoid_fixation
