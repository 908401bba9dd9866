// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/find_cases.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "case_io/lesson_file.hpp"
#include "case_io/trust_file.hpp"
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

TEST_F(FindCases, TellsWhatIsToBeCheckedAndNotThatABoneIsInParts) {
  make("doubtful");
  make("damaged");
  std::ofstream(folder_ / "doubtful" / case_io::kTrustFile)
      << case_io::trust_text({{{"lunate", 0.9, false, ""},
                               {"scaphoid_proximal", 0.2, true, "look"},
                               {"scaphoid_distal", 0.1, true, "look"}},
                              {"the wrist is small"}},
                             "carpus");
  std::ofstream(folder_ / "damaged" / case_io::kTrustFile) << "{";
  const FoundCases found = find_cases({path()});
  EXPECT_TRUE(found.shelf.find("damaged")->flagged.empty());
  EXPECT_TRUE(found.shelf.find("damaged")->of_scan.empty());
  EXPECT_EQ(found.shelf.find("doubtful")->flagged, std::vector<std::string>{"scaphoid"});
  EXPECT_EQ(found.shelf.find("doubtful")->of_scan, std::vector<std::string>{"the wrist is small"});
  EXPECT_EQ(message_of(found.shelf).cases[1].of_scan, found.shelf.cases[1].of_scan);
}

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

TEST_F(FindCases, OneThatNobodyOpenedYetIsNotBelieved) {
  make("a");
  for (const std::string& text :
       {std::string(300'000, '[') + std::string(300'000, ']'), std::string("{"),
        std::string(R"({"pseudonym": "a\u202Ebc"})"), std::string(R"({"pseudonym": "a\u001b[2J"})"),
        R"({"pseudonym": ")" + std::string(200, 'x') + R"("})"}) {
    std::ofstream(folder_ / "a" / "case.json") << text;
    EXPECT_EQ(find_cases({path()}).shelf.cases[0].title, "a") << text.substr(0, 40);
  }
  fs::remove(folder_ / "a" / "case.json");
  ASSERT_EQ(::mkfifo((folder_ / "a" / "case.json").c_str(), 0600), 0);
  EXPECT_EQ(find_cases({path()}).shelf.cases[0].title, "a") << "a pipe";
}

TEST_F(FindCases, APreviewThatIsALinkIsNotHandedOut) {
  make("a", 20);
  const fs::path preview = folder_ / "a" / case_io::kPreviewFile;
  std::ofstream(folder_ / "secret") << "of this machine";
  fs::remove(preview);
  fs::create_symlink(folder_ / "secret", preview);
  EXPECT_EQ(find_cases({path()}).shelf.cases[0].preview, nullptr);
  fs::remove(preview);
  std::ofstream(preview) << std::string((1U << 20U) + 1, 'x');
  EXPECT_EQ(find_cases({path()}).shelf.cases[0].preview, nullptr) << "larger than a picture";
}

TEST_F(FindCases, ALessonThatIsWrongIsSaid) {
  make("a");
  std::ofstream(folder_ / "a" / case_io::kLessonFile) << "{}";
  EXPECT_THROW((void)find_cases({path()}), InvalidInput);
}

}  // namespace
}  // namespace carpus::cli
