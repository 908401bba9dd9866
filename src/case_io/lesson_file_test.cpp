// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/lesson_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

cases::Lesson lesson() {
  cases::Lesson l;
  l.title = "Waist, in place";
  l.history = "Man, 24. Fell four days ago.";
  l.goal = "Find the fracture on the PA.";
  l.size = "average";
  l.right_answer = cases::RightAnswer::ReduceFirst;
  l.reason = "It has a step of 1.8 mm.";
  l.difficulty = {1.25, 21.5, 9.0, 1.5, 1.8, 5.0, 37.5};
  l.expert = {"dorsal_scaphoid_fixation", 3, true, 91.5};
  return l;
}

std::string changed(const char* pointer, const nlohmann::json& value) {
  nlohmann::json json = nlohmann::json::parse(lesson_text(lesson()));
  json[nlohmann::json::json_pointer(pointer)] = value;
  return json.dump();
}

TEST(LessonFile, GivesBackWhatWasWritten) {
  cases::Lesson l = lesson();
  EXPECT_EQ(parse_lesson(lesson_text(l), "lesson.json"), l);
  l.expert.reset();
  l.history.clear();
  l.right_answer = cases::RightAnswer::Decline;
  l.decline_for = {"flexed", "bone_lost"};
  EXPECT_EQ(parse_lesson(lesson_text(l), "lesson.json"), l);
}

TEST(LessonFile, ReadsOneOfTheFirstVersion) {
  nlohmann::json json = nlohmann::json::parse(changed("/schema_version", 1));
  json.erase("history");
  EXPECT_EQ(parse_lesson(json.dump(), "lesson.json").history, "");
}

TEST(LessonFile, RefusesReasonsThatAreNoIds) {
  nlohmann::json json = nlohmann::json::parse(changed("/right_answer", "decline"));
  json["decline_for"] = {"Too flexed"};
  EXPECT_THROW((void)parse_lesson(json.dump(), "lesson.json"), InvalidInput);
  json["decline_for"] = "flexed";
  EXPECT_THROW((void)parse_lesson(json.dump(), "lesson.json"), InvalidInput);
}

TEST(LessonFile, ACaseNeedNotHaveOne) { EXPECT_FALSE(read_lesson("/nowhere")); }

TEST(LessonFile, RefusesWhatIsWrong) {
  for (const std::string& text :
       {std::string("{"), std::string("[]"), changed("/format", "carpus case"),
        changed("/title", ""), changed("/title", std::string(129, 'a')),
        changed("/goal", "two\nlines"), changed("/size", "huge"),
        changed("/right_answer", "amputate"), changed("/difficulty/overall", 101),
        changed("/difficulty/gap_mm", "wide"), changed("/difficulty/colour", 1),
        changed("/expert/is_acceptable", "yes"), changed("/expert/seed", -1),
        changed("/history", "tab\t"), changed("/decline_for", {"flexed"}),
        changed("/solution", "fix")}) {
    EXPECT_THROW((void)parse_lesson(text, "lesson.json"), InvalidInput) << text;
  }
}

TEST(LessonFile, RefusesANewerOneByItsVersion) {
  try {
    (void)parse_lesson(changed("/schema_version", 3), "lesson.json");
    FAIL();
  } catch (const SchemaError& error) {
    EXPECT_NE(std::string(error.what()).find("version 3"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace carpus::case_io
