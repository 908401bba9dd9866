// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/label_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "anatomy/bone_id.hpp"
#include "core/error.hpp"

namespace carpus::reconstruct {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string refusal(const std::string& text) {
  try {
    (void)parse_label_names(text, "names.json");
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), StartsWith("names.json: "));
    return error.what();
  }
  return "accepted";
}

TEST(LabelNames, GiveEachNumberItsBone) {
  const LabelNumbers map =
      parse_label_names(R"({"radius": 255, "scaphoid_distal": 2, "scaphoid_proximal": 1})", "n");
  EXPECT_EQ(map[255], static_cast<int>(BoneId::Radius));
  EXPECT_EQ(map[2], kScaphoidDistalLabel);
  EXPECT_EQ(map[1], static_cast<int>(BoneId::Scaphoid));
  EXPECT_EQ(std::count(map.begin(), map.end(), 0), 253);
}

TEST(LabelNames, MayBeThoseOfASimulatedScan) {
  EXPECT_EQ(parse_label_names(R"({"background": 0, "lunate": 4, "fracture_gap": 17})", "n"),
            parse_label_names(R"({"lunate": 4})", "n"));
  EXPECT_THAT(refusal(R"({"background": 1, "lunate": 4})"), HasSubstr("no bone 'background'"));
  EXPECT_THAT(refusal(R"({"fracture_gap": "17"})"), HasSubstr("no bone 'fracture_gap'"));
  EXPECT_THAT(refusal(R"({"background": 0})"), HasSubstr("names no bone"));
}

TEST(LabelNames, AreRefusedWhereTheyCouldMeanTwoThings) {
  // The second would win, and voxels of the first would be no bone's.
  EXPECT_THAT(refusal(R"({"lunate": 1, "lunate": 2})"), HasSubstr("'lunate' is there twice"));
  EXPECT_THAT(refusal(R"({"scaphoid": 1, "scaphoid_proximal": 2})"), HasSubstr("the same bone"));
  EXPECT_THAT(refusal(R"({"lunate": 1, "hamate": 1})"), HasSubstr("two bones"));
}

TEST(LabelNames, AreRefusedWhereTheyAreNone) {
  EXPECT_THAT(refusal(""), HasSubstr("parse error"));
  EXPECT_THAT(refusal("{}"), HasSubstr("no list of names"));
  EXPECT_THAT(refusal("[1]"), HasSubstr("no list of names"));
  EXPECT_THAT(refusal(std::string(30000, '[')), HasSubstr("too deeply"));
  EXPECT_THAT(refusal(R"({"radius": {"radius": 1}})"), HasSubstr("twice"));
  for (const char* number : {"0", "256", "-1", "1.5", "1e30", "\"1\"", "[1]", "true"}) {
    EXPECT_THAT(refusal(std::string(R"({"radius": )") + number + "}"), HasSubstr("from 1 to 255"));
  }
}

}  // namespace
}  // namespace carpus::reconstruct
