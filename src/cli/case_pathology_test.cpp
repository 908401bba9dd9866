// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/case_pathology.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "arthroscopy/named_grades.hpp"
#include "case_io/pathology_file.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using arthroscopy::PathologyTable;

TEST(CasePathology, IsWrittenReplacedAndTakenAway) {
  const fs::path folder =
      fs::temp_directory_path() / ("carpus_pathology_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto drawn = arthroscopy::drawn_pathology(7, PathologyTable::generic());
  write_pathology(folder, drawn);
  EXPECT_EQ(case_io::read_pathology(folder), drawn);
  write_pathology(folder, cases::PreparedPathology{});
  EXPECT_EQ(case_io::read_pathology(folder), cases::PreparedPathology{});
  write_pathology(folder, std::nullopt);
  write_pathology(folder, std::nullopt);
  EXPECT_EQ(case_io::read_pathology(folder), std::nullopt);
  EXPECT_TRUE(fs::is_empty(folder)) << "nothing half-written is left";
  fs::remove_all(folder);
  EXPECT_THROW(write_pathology(folder, drawn), IoError);
}

TEST(CasePathology, SaysWhatACaseWithoutTheirPlacesCannotShow) {
  cases::PreparedPathology torn;
  ASSERT_TRUE(set_grade(torn.grades, PathologyTable::generic(), "scapholunate", "III"));
  cases::CaseData data;
  EXPECT_EQ(findings_without_place(data, torn), std::vector<std::string>{"Scapholunate ligament"});
  data.arthroscopy = std::make_shared<cases::ArthroscopicMap>();
  EXPECT_EQ(findings_without_place(data, torn).size(), 1U) << "no place of the tour";
  EXPECT_TRUE(findings_without_place(data, {}).empty());
}

}  // namespace
}  // namespace carpus::cli
