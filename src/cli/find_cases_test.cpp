// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/find_cases.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "case_io/lesson_file.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

class FindCases : public ::testing::Test {
 protected:
  FindCases() { fs::create_directories(folder_); }
  ~FindCases() override { fs::remove_all(folder_); }

  void make(const std::string& name, std::optional<double> difficulty = {}) const {
    fs::create_directories(folder_ / name);
    std::ofstream(folder_ / name / "case.json") << "{}";
    if (!difficulty) return;
    cases::Lesson lesson;
    lesson.title = "Title of " + name;
    lesson.history = "Fell.";
    lesson.goal = "g";
    lesson.size = "small";
    lesson.reason = "r";
    lesson.difficulty.overall = *difficulty;
    std::ofstream(folder_ / name / case_io::kLessonFile) << case_io::lesson_text(lesson);
    std::ofstream(folder_ / name / case_io::kPreviewFile) << "picture";
  }
  [[nodiscard]] std::string path(const std::string& name = "") const {
    return (folder_ / name).string();
  }

  fs::path folder_ =
      fs::temp_directory_path() / ("carpus_find_cases_" + std::to_string(::getpid()));
};

TEST_F(FindCases, AFolderOfThemGivesAllEasiestFirst) {
  make("plain");
  make("hard", 70);
  make("easy", 20);
  fs::create_directories(folder_ / "no_case");
  const FoundCases found = find_cases({path()});
  ASSERT_EQ(found.shelf.cases.size(), 3U);
  EXPECT_EQ(found.shelf.cases[0].id, "easy");
  EXPECT_EQ(found.shelf.cases[0].title, "Title of easy");
  EXPECT_EQ(found.shelf.cases[0].history, "Fell.");
  EXPECT_EQ(*found.shelf.cases[0].preview, "picture");
  EXPECT_EQ(found.shelf.cases[1].id, "hard");
  EXPECT_EQ(found.shelf.cases[2].title, "plain");
  EXPECT_FALSE(found.shelf.cases[2].difficulty);
  EXPECT_EQ(found.shelf.open, "easy");
  EXPECT_EQ(found.folders.at("hard"), folder_ / "hard");
}

TEST_F(FindCases, SeveralMayBeNamedButNoneTwice) {
  make("a");
  make("b");
  const FoundCases found = find_cases({path("b"), path("a/")});
  EXPECT_EQ(found.shelf.cases.size(), 2U);
  EXPECT_EQ(found.shelf.open, "b") << "the one that was named first";
  EXPECT_THROW((void)find_cases({path(), path("a")}), InvalidInput);
}

TEST_F(FindCases, OneWithoutALessonIsCalledAsItCallsItself) {
  make("a");
  std::ofstream(folder_ / "a" / "case.json") << R"({"pseudonym": "demo wrist"})";
  EXPECT_EQ(find_cases({path()}).shelf.cases[0].title, "demo wrist");
}

TEST_F(FindCases, ALessonThatIsWrongIsSaid) {
  make("a");
  std::ofstream(folder_ / "a" / case_io::kLessonFile) << "{}";
  EXPECT_THROW((void)find_cases({path()}), InvalidInput);
}

}  // namespace
}  // namespace carpus::cli
