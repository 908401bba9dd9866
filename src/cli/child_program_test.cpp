// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/child_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/error.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;

TEST(ChildProgram, ItsWordsAreKeptAndItsFailureTellsTheLast) {
  const fs::path log = fs::path(testing::TempDir()) / "child.log";
  const fs::path shell = find_on_path({"no-such-program-anywhere", "sh"});
  ASSERT_FALSE(shell.empty());
  run_program(shell, {"-c", "echo out; echo err >&2"}, log);
  std::ifstream file(log);
  const std::string said{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(said, "out\nerr\n");
  try {
    run_program(shell, {"-c", "echo 1; echo 2; echo 3; echo 4; echo five; exit 3"}, log);
    FAIL() << "a failure passed";
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("failed:\n  2\n  3\n  4\n  five"));
  }
  EXPECT_THROW(run_program("/no/such/program", {}, log), IoError);
  EXPECT_TRUE(find_on_path({"no-such-program-anywhere"}).empty());
  fs::remove(log);
}

}  // namespace
}  // namespace carpus::cli
