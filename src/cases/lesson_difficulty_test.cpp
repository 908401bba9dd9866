// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/lesson_difficulty.hpp"

#include <gtest/gtest.h>

namespace carpus::cases {
namespace {

constexpr double kScrewMm = 1.8;

/// An axis of 28 mm along x within a cylinder.
ScaphoidLandmarks scaphoid(double radius_mm, double length_mm = 28) {
  ScaphoidLandmarks s;
  s.central_axis = {{0, 0, 0}, {length_mm, 0, 0}};
  s.central_radius_mm = radius_mm;
  return s;
}

FractureFacts across_at(double x) { return {{x, 5, 0}, {1, 0, 0}, 0, 0, 0}; }

TEST(LessonDifficulty, AWideLongCorridorThroughTheMiddleIsEasy) {
  const Difficulty d = difficulty_of(scaphoid(3.8), across_at(14), kScrewMm);
  EXPECT_DOUBLE_EQ(d.corridor_clearance_mm, 2.0);
  EXPECT_DOUBLE_EQ(d.corridor_length_mm, 24);
  EXPECT_DOUBLE_EQ(d.smaller_part_mm, 14);
  EXPECT_NEAR(d.overall, 0, 1e-9);
}

TEST(LessonDifficulty, EachThingThatIsHardCounts) {
  EXPECT_NEAR(difficulty_of(scaphoid(2.1), across_at(14), kScrewMm).overall, 40, 1e-9);
  EXPECT_NEAR(difficulty_of(scaphoid(3.8), across_at(4), kScrewMm).overall, 30, 1e-9);
  EXPECT_NEAR(difficulty_of(scaphoid(3.8), across_at(24), kScrewMm).overall, 30, 1e-9);
  EXPECT_NEAR(difficulty_of(scaphoid(3.8, 18), {}, kScrewMm).overall, 10, 1e-9);
  FractureFacts apart = across_at(14);
  apart.gap_mm = 2.5;
  EXPECT_NEAR(difficulty_of(scaphoid(3.8), apart, kScrewMm).overall, 20, 1e-9);
  apart = across_at(14);
  apart.step_mm = 1.25;
  EXPECT_NEAR(difficulty_of(scaphoid(3.8), apart, kScrewMm).overall, 10, 1e-9);
  apart.flexion_deg = 30;
  EXPECT_NEAR(difficulty_of(scaphoid(3.8), apart, kScrewMm).overall, 20, 1e-9);
}

TEST(LessonDifficulty, AnObliqueFractureIsMeasuredAlongTheAxis) {
  FractureFacts oblique{{10, 6, 0}, normalized_or({1, 1, 0}, {}), 0, 0, 0};  // meets it at 16
  EXPECT_NEAR(difficulty_of(scaphoid(3), oblique, kScrewMm).smaller_part_mm, 12, 1e-9);
  oblique.normal = {0, 1, 0};  // along the axis: no side is shorter
  EXPECT_DOUBLE_EQ(difficulty_of(scaphoid(3), oblique, kScrewMm).smaller_part_mm, 28);
}

}  // namespace
}  // namespace carpus::cases
