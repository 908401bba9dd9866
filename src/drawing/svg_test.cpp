// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "drawing/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carpus::drawing {
namespace {

TEST(Svg, ColoursAreClampedBytes) {
  EXPECT_EQ(hex({0, 0.5, 1}), "#0080ff");
  EXPECT_EQ(hex({-1, 2, 0}), "#00ff00");
}

TEST(Svg, TextEscapesWhatSvgMeansOtherwise) {
  EXPECT_THAT(text_at(1, 2, "a<b & c>d"), testing::HasSubstr(">a&lt;b &amp; c>d</text>"));
}

TEST(Svg, TextIsMadeToFitItsWidth) {
  EXPECT_DOUBLE_EQ(fitting_size("short", 20, 1000), 20);
  EXPECT_DOUBLE_EQ(fitting_size("ten signs!", 20, 60), 10);
  EXPECT_DOUBLE_EQ(fitting_size("", 20, 60), 20);
}

TEST(Svg, AnEmptyPathDrawsNothing) {
  EXPECT_EQ(strokes("", {"#000000"}), "");
  EXPECT_THAT(strokes(line_path({0, 1}, {2, 3}), {"#000000", 3}),
              testing::HasSubstr("d=\"M0.0 1.0L2.0 3.0\""));
}

}  // namespace
}  // namespace carpus::drawing
