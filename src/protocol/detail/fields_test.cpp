// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What codecs may be made of, whether or not a message of today uses it.
#include "protocol/detail/fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

namespace carpus::protocol {
namespace {

using ::testing::ElementsAre;

/// What is wrong with a text after reading from it; empty when nothing.
template <typename Read>
std::string problem(const std::string& text, Read read_fields) {
  JsonText json(text, 1000);
  FieldReader in(json);
  read_fields(in);
  in.finish();
  return json.failure().value_or("");
}

TEST(FieldReader, ReadsListsOfEveryKind) {
  const std::string text = R"({"n":[0.5,2],"i":[3,4.0],"s":["a","b"],"v":[[1,2,3]],"f":[7,8]})";
  std::vector<double> numbers;
  std::vector<std::int64_t> integers;
  std::vector<std::string> strings;
  std::vector<Vec3> points;
  std::array<double, 2> fixed{};
  const std::string wrong = problem(text, [&](FieldReader& in) {
    in.list("n", 0, 2, 0.0, 10.0, numbers);
    in.list("i", 2, 2, 0, 10, integers);
    in.list("s", 0, 5, 1, strings);
    in.list("v", 0, 5, 5.0, 0.0, points);
    in.fill("f", 0.0, 10.0, fixed);
  });
  EXPECT_EQ(wrong, "");
  EXPECT_THAT(numbers, ElementsAre(0.5, 2.0));
  EXPECT_THAT(integers, ElementsAre(3, 4));
  EXPECT_THAT(strings, ElementsAre("a", "b"));
  EXPECT_THAT(points, ElementsAre(Vec3{1, 2, 3}));
  EXPECT_THAT(fixed, ElementsAre(7.0, 8.0));
}

TEST(FieldReader, RefusesAListByItsLengthAndByItsFirstWrongItem) {
  std::vector<double> numbers;
  const auto of_numbers = [&](const std::string& text) {
    return problem(text, [&](FieldReader& in) { in.list("n", 0, 2, 0.0, 10.0, numbers); });
  };
  EXPECT_EQ(of_numbers(R"({"n":[1,2,3]})"), "field 'n' must be a list of at most 2");
  EXPECT_EQ(of_numbers(R"({"n":[1,11]})"), "field 'n[1]' must be a number from 0.0 to 10.0");
  std::vector<std::int64_t> integers;
  EXPECT_EQ(
      problem(R"({"i":[1,2.5]})", [&](FieldReader& in) { in.list("i", 2, 2, 0, 10, integers); }),
      "field 'i[1]' must be an integer from 0 to 10");
  std::vector<Vec3> points;
  EXPECT_EQ(
      problem(R"({"v":[[1,2]]})", [&](FieldReader& in) { in.list("v", 0, 2, 5.0, 0.0, points); }),
      "field 'v[0]' must be three numbers from -5.0 to 5.0");
  std::vector<std::string> strings;
  EXPECT_EQ(problem(R"({"s":["aa"]})", [&](FieldReader& in) { in.list("s", 0, 2, 1, strings); }),
            "field 's[0]' must be a string of at most 1 characters without control characters");
}

TEST(FieldReader, ReadsNothingMoreOnceSomethingWasWrong) {
  JsonText json(R"({"a":1,"b":true})", 1000);
  FieldReader in(json);
  EXPECT_EQ(in.boolean("a"), false);
  EXPECT_EQ(in.boolean("b"), false) << "a default, not the value";
  EXPECT_FALSE(in.has("b"));
  EXPECT_EQ(json.failure(), "field 'a' must be true or false");
}

TEST(FieldWriter, WritesListsOfEveryKind) {
  JsonWriter json;
  FieldWriter out = json.root();
  out.list("n", std::vector<double>{0.5});
  out.list("i", std::vector<std::int64_t>{1, 2});
  out.list("s", std::vector<std::string>{"abc"}, 2);
  out.list("v", std::vector<Vec3>{{1, 2, 3}});
  EXPECT_EQ(json.dump(-1), R"({"n":[0.5],"i":[1,2],"s":["a…"],"v":[[1.0,2.0,3.0]]})");
  EXPECT_EQ(json.dump_field("i", -1), "[1,2]");
}

}  // namespace
}  // namespace carpus::protocol
