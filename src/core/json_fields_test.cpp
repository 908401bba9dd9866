// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/json_fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/error.hpp"

namespace carpus {
namespace {

using testing::HasSubstr;

std::string problem_of(const char* text, const std::function<void(JsonFields&)>& read) {
  const nlohmann::json value = parse_json_text(text, "tools.json");
  try {
    JsonFields fields(value, "tools.json", "wire");
    read(fields);
  } catch (const InvalidInput& problem) {
    return problem.what();
  }
  return "";
}

TEST(JsonFields, TellFilePlaceFieldAndWhatIsWrong) {
  const auto read_length = [](JsonFields& f) { (void)f.number("length_mm", 0, 200); };
  EXPECT_EQ(problem_of("{}", read_length), "tools.json: wire: length_mm is missing");
  EXPECT_EQ(problem_of(R"({"length_mm": "80"})", read_length),
            "tools.json: wire: length_mm is no number");
  EXPECT_EQ(problem_of(R"({"length_mm": 300})", read_length),
            "tools.json: wire: length_mm is 300, must be 0 to 200");
  EXPECT_EQ(problem_of(R"({"length_mm": 80})", read_length), "");
  EXPECT_EQ(problem_of("[]", read_length), "tools.json: wire: is no object");
  EXPECT_EQ(problem_of(R"({"name": ""})", [](JsonFields& f) { (void)f.text("name"); }),
            "tools.json: wire: name is empty");
  EXPECT_EQ(
      problem_of(R"({"a": [1, 2, "3"]})", [](JsonFields& f) { (void)f.numbers("a", 3, 0, 9); }),
      "tools.json: wire: a[2] must be a number from 0 to 9");
}

TEST(JsonFields, NumbersThatAreNotFiniteDoNotGetIn) {
  EXPECT_THROW((void)parse_json_text(R"({"length_mm": 1e999})", "tools.json"), InvalidInput);
  EXPECT_THROW((void)parse_json_text(R"({"length_mm": NaN})", "tools.json"), InvalidInput);
}

TEST(JsonFields, WordsAreOneOfThoseKnown) {
  constexpr std::array<std::string_view, 2> kWords{"steel", "titanium"};
  std::size_t chosen = 9;
  EXPECT_EQ(
      problem_of(R"({"m": "titanium"})", [&](JsonFields& f) { chosen = f.choice("m", kWords); }),
      "");
  EXPECT_EQ(chosen, 1U);
  EXPECT_EQ(problem_of(R"({"m": "wood"})", [&](JsonFields& f) { (void)f.choice("m", kWords); }),
            "tools.json: wire: m is 'wood', must be one of steel, titanium");
}

TEST(JsonFields, AMisspeltOptionalFieldIsRefused) {
  EXPECT_EQ(problem_of(R"({"stay": true})",
                       [](JsonFields& f) {
                         EXPECT_FALSE(f.boolean_or("stays", false));
                         f.refuse_unknown_fields();
                       }),
            "tools.json: wire: there is no field 'stay'");
}

TEST(JsonFields, ObjectsOfAListCarryTheirPlace) {
  EXPECT_EQ(problem_of(R"({"steps": [{"id": "a"}, {}]})",
                       [](JsonFields& f) {
                         for (JsonFields& step : f.objects("steps")) (void)step.text("id");
                       }),
            "tools.json: wire: steps[1]: id is missing");
}

TEST(JsonFields, TextThatIsNoJsonSaysWhere) {
  try {
    (void)parse_json_text("{\n  \"a\": }", "tools.json");
    FAIL();
  } catch (const InvalidInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("tools.json"));
    EXPECT_THAT(problem.what(), HasSubstr("line 2"));
  }
}

}  // namespace
}  // namespace carpus
