// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/person_name.hpp"

#include <gtest/gtest.h>

#include <string>

namespace carpus {
namespace {

TEST(PersonName, AnyAlphabetIsAccepted) {
  for (const char* name : {"", "Ada", "R. Haddad-Øst", "Zoë", "José María", "张伟", "नेहा", "محمد",
                           "Ὀδυσσεύς", "👩‍⚕️", "O'Neill <script>", "z̴̡̛͖a"}) {
    EXPECT_EQ(problem_of_name(name), std::nullopt) << name;
  }
}

TEST(PersonName, ControlCharactersAreRefusedByTheirNumber) {
  for (const auto& [name, number] : std::initializer_list<std::pair<std::string, const char*>>{
           {"Ada\n", "U+000A"},
           {"Ada\tB", "U+0009"},
           {std::string("A\0B", 3), "U+0000"},
           {"\x1b[31mAda", "U+001B"},
           {"Ada\x7f", "U+007F"},
           {"Ada\u0085", "U+0085"},
           {"Ada\u2028Bo", "U+2028"}}) {
    const auto problem = problem_of_name(name);
    ASSERT_TRUE(problem.has_value()) << number;
    EXPECT_NE(problem->find("control character"), std::string::npos);
    EXPECT_NE(problem->find(number), std::string::npos) << *problem;
  }
}

TEST(PersonName, WhatTurnsTheDirectionOfWritingIsRefused) {
  for (const char* name : {"\u202aA", "\u202bA", "A\u202c", "A\u202d", "gpj.\u202eada", "\u2066A",
                           "\u2067A", "\u2068A", "A\u2069"}) {
    const auto problem = problem_of_name(name);
    ASSERT_TRUE(problem.has_value()) << name;
    EXPECT_NE(problem->find("direction of writing (U+20"), std::string::npos) << *problem;
  }
}

TEST(PersonName, BytesThatAreNoTextAreRefused) {
  for (const char* name :
       {"\xff", "\xc3", "\xc3(", "\x80", "\xc0\x80", "\xf5\x80\x80\x80", "A\xe2\x82"}) {
    EXPECT_TRUE(problem_of_name(name).has_value());
  }
}

}  // namespace
}  // namespace carpus
