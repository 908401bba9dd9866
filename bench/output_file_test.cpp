// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/output_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "core/error.hpp"

namespace carpus::bench {
namespace {

namespace fs = std::filesystem;

class OutputFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string text_in(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_ =
      fs::temp_directory_path() / ("carpus_output_file_" + std::to_string(::getpid()));
};

TEST_F(OutputFile, AMissingFolderIsNamedBeforeTheRun) {
  const fs::path file = folder_ / "missing" / "rows.json";
  try {
    check_writable(file);
    FAIL() << "no complaint";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find((folder_ / "missing").string()), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(folder_ / "missing"));
}

TEST_F(OutputFile, AFolderIsNoFile) { EXPECT_THROW(check_writable(folder_), IoError); }

TEST_F(OutputFile, AskingCreatesNothing) {
  check_writable(folder_ / "rows.json");
  check_writable("rows.json");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(OutputFile, AFailureLeavesTheEarlierFileAndNoOther) {
  const fs::path file = folder_ / "plot.svg";
  write_text(file, "whole");
  const auto half = [](const fs::path& part) {
    std::ofstream(part) << "ha";
    throw IoError("the disk is full");
  };
  EXPECT_THROW(write_whole(file, half), IoError);
  EXPECT_EQ(text_in(file), "whole");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(OutputFile, WhatCannotBeWrittenIsAnError) {
  EXPECT_THROW(write_text(folder_ / "missing" / "rows.json", "{}"), IoError);
}

}  // namespace
}  // namespace carpus::bench
