// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/json_nesting.hpp"

#include <gtest/gtest.h>

#include <string>

namespace carpus {
namespace {

TEST(JsonNesting, CountsArraysAndObjectsThatAreOpenAtOnce) {
  EXPECT_FALSE(nests_deeper_than("", 0));
  EXPECT_FALSE(nests_deeper_than("7", 0));
  EXPECT_TRUE(nests_deeper_than("[]", 0));
  EXPECT_FALSE(nests_deeper_than(R"([{"a": [1, 2]}, {"b": []}, [[]]])", 3));
  EXPECT_TRUE(nests_deeper_than(R"([{"a": [1, 2]}])", 2));
  EXPECT_TRUE(nests_deeper_than(std::string(1'000'000, '['), 16));
}

TEST(JsonNesting, CountsNothingWithinTexts) {
  EXPECT_FALSE(nests_deeper_than(R"(["[[[[", "\"[[[["])", 1));
  EXPECT_FALSE(nests_deeper_than("\"[[[[", 0)) << "a text without its end";
  EXPECT_FALSE(nests_deeper_than("\"\\", 0));
}

}  // namespace
}  // namespace carpus
