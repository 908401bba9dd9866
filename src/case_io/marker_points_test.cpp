// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/marker_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

using testing::HasSubstr;

std::string refusal_of(const std::string& text) {
  try {
    (void)parse_marker_points(text, "markers.csv");
  } catch (const IoError& error) {
    return error.what();
  }
  return "taken";
}

TEST(MarkerPoints, AreLabelPlaceAndRadius) {
  const auto markers = parse_marker_points(
      "label,x,y,z,radius\n3, -1.5, 2, 1e2, 0.8\r\n\n4;0;0;0  # the lunate\n", "markers.csv");
  ASSERT_EQ(markers.size(), 2U);
  EXPECT_EQ(markers[0].label, 3);
  EXPECT_EQ(markers[0].place, (Vec3{-1.5, 2, 100}));
  EXPECT_EQ(markers[0].radius_mm, 0.8);
  EXPECT_EQ(markers[1].label, 4);
  EXPECT_EQ(markers[1].radius_mm, 0);
}

TEST(MarkerPoints, AreRefusedByFileAndLine) {
  EXPECT_THAT(refusal_of(""), HasSubstr("holds no marker"));
  EXPECT_THAT(refusal_of("label,x,y,z\n"), HasSubstr("holds no marker"));
  EXPECT_THAT(refusal_of("1,2,3,4\n0,2,3,4\n"), HasSubstr("2"));
  EXPECT_THAT(refusal_of("256,2,3,4\n"), HasSubstr("from 1 to 255"));
  EXPECT_THAT(refusal_of("1.5,2,3,4\n"), HasSubstr("markers.csv"));
  EXPECT_THAT(refusal_of("1,2,3\n"), HasSubstr("markers.csv"));
  EXPECT_THAT(refusal_of("1,2,nan,3\n"), HasSubstr("markers.csv"));
  EXPECT_THAT(refusal_of("1,2,3,4,-1\n"), HasSubstr("radius"));
  EXPECT_THAT(refusal_of("1,2,3,4,5,6\n"), HasSubstr("more than"));
}

}  // namespace
}  // namespace carpus::case_io
