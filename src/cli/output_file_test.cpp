// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class OutputFile : public ::testing::Test {
 protected:
  OutputFile() { fs::create_directories(folder_); }
  ~OutputFile() override { fs::remove_all(folder_); }

  /// Empty where the file may be written.
  static std::string refusal(const fs::path& file) {
    std::string text = file.string();
    return output_file()(text);
  }

  const fs::path folder_ = fs::path(::testing::TempDir()) / "output_file_test";
};

TEST_F(OutputFile, MayBeNewOrThere) {
  EXPECT_EQ(refusal(folder_ / "new.json"), "");
  std::ofstream(folder_ / "old.json") << "{}";
  EXPECT_EQ(refusal(folder_ / "old.json"), "");
  EXPECT_EQ(refusal("here.json"), "");
}

TEST_F(OutputFile, NeedsItsFolderBeforeTheWork) {
  EXPECT_THAT(refusal(folder_ / "missing" / "new.json"), HasSubstr("create it first"));
  EXPECT_FALSE(fs::exists(folder_ / "missing"));
  std::ofstream(folder_ / "file") << "";
  EXPECT_THAT(refusal(folder_ / "file" / "new.json"), HasSubstr("there is no folder"));
}

TEST_F(OutputFile, IsNoDevice) {
  EXPECT_THAT(refusal("/dev/stdout"), HasSubstr("is a device"));
  EXPECT_THAT(refusal("/dev/null"), HasSubstr("is a device"));
}

TEST_F(OutputFile, IsNoFolder) { EXPECT_THAT(refusal(folder_), HasSubstr("is a folder")); }

}  // namespace
}  // namespace carpus::cli
