// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "case_io/case_folder.hpp"
#include "case_io/lesson_file.hpp"
#include "core/error.hpp"
#include "stock/make_stock_case.hpp"
#include "stock/stock_list.hpp"

namespace carpus::stock {
namespace {

namespace fs = std::filesystem;

TEST(StockList, HasEveryKindSizeSideAndAnswer) {
  std::set<std::string> ids;
  std::set<phantom::FractureKind> kinds;
  std::set<std::string> sizes;
  std::set<Side> sides;
  std::set<cases::RightAnswer> answers;
  for (const StockItem& item : stock_list()) {
    ids.insert(item.id);
    kinds.insert(item.wrist.fracture);
    sizes.insert(item.lesson.size);
    sides.insert(item.wrist.side);
    answers.insert(item.lesson.right_answer);
    EXPECT_FALSE(item.lesson.history.empty()) << item.id;
    EXPECT_EQ(item.lesson.decline_for.empty(),
              item.lesson.right_answer != cases::RightAnswer::Decline)
        << item.id;
    const bool is_in_place = item.lesson.right_answer == cases::RightAnswer::Fix;
    const bool is_two = item.wrist.fracture == phantom::FractureKind::Displaced ||
                        item.wrist.fracture == phantom::FractureKind::Humpback;
    EXPECT_NE(is_in_place, is_two) << item.id;
    EXPECT_EQ(case_io::parse_lesson(case_io::lesson_text(item.lesson), item.id), item.lesson)
        << "its words are those of a lesson";
  }
  EXPECT_EQ(ids.size(), stock_list().size());
  EXPECT_GE(kinds.size(), 5U);
  EXPECT_EQ(sizes.size(), 3U);
  EXPECT_EQ(sides.size(), 2U);
  EXPECT_EQ(answers.size(), 3U);
}

TEST(StockList, RefusesWhatIsWrong) {
  const std::string item =
      R"({"id":"a","title":"t","history":"h","goal":"g","fracture":"waist","side":"left","scale":1,)"
      R"("size":"small","seed":1,"right_answer":"fix","reason":"r"})";
  const auto list = [](const std::string& items) {
    return R"({"schema_version":1,"cases":[)" + items + "]}";
  };
  EXPECT_EQ(read_stock_list(list(item), "x.json").size(), 1U);
  EXPECT_THROW((void)read_stock_list(list(item + "," + item), "x.json"), InvalidInput);
  std::string away = item;
  away.replace(away.find("\"a\""), 3, "\"../a\"");
  EXPECT_THROW((void)read_stock_list(list(away), "x.json"), InvalidInput);
}

TEST(StockCase, IsMadeOfACaseALessonAndAPicture) {
  StockItem item = stock_list().front();
  item.wrist.fracture = phantom::FractureKind::Nonunion;  // a fine line needs fine voxels
  item.wrist.spacing = {0.5, 0.5, 0.6};
  item.lesson.right_answer = cases::RightAnswer::Decline;  // the expert has tests of its own
  const fs::path folder =
      fs::temp_directory_path() / ("carpus_stock_" + std::to_string(::getpid()));
  EXPECT_FALSE(is_made(folder, item));
  const cases::Lesson lesson = make_stock_case(item, folder, "2026-01-01T00:00:00Z");
  EXPECT_TRUE(is_made(folder, item));
  EXPECT_EQ(case_io::read_lesson(folder), lesson);
  EXPECT_FALSE(lesson.expert);
  EXPECT_GT(lesson.difficulty.corridor_clearance_mm, 0);
  EXPECT_GT(lesson.difficulty.smaller_part_mm, 8);
  EXPECT_LT(lesson.difficulty.smaller_part_mm, 14);
  const cases::CaseData data = case_io::read_case(folder);
  EXPECT_TRUE(data.provenance.simulated);
  EXPECT_EQ(data.side, item.wrist.side);
  EXPECT_EQ(data.pseudonym, "patient 1") << "it is on the screen, and tells no diagnosis";
  EXPECT_EQ(data.provenance.source.find("nonunion"), std::string::npos);

  StockItem reworded = item;
  reworded.lesson.goal = "Something else.";
  EXPECT_FALSE(is_made(folder, reworded));
  std::ofstream(folder / case_io::kLessonFile) << "{";
  EXPECT_FALSE(is_made(folder, item)) << "damaged";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace carpus::stock
