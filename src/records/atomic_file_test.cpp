// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "core/error.hpp"
#include "records/records_test_support.hpp"
#include "records/utc_time.hpp"

namespace carpus::records {
namespace {

using testing::FileSizeLimit;
using testing::TemporaryFolder;

std::size_t count_files(const TemporaryFolder& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++count;
  }
  return count;
}

std::string text_of(const std::filesystem::path& file) {
  const auto bytes = read_file(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(AtomicFile, ReplacesAFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "one");
  write_file_atomically(folder / "a", "two");
  EXPECT_EQ(text_of(folder / "a"), "two");
  EXPECT_EQ(count_files(folder), 1U);
}

TEST(AtomicFile, FullDiskKeepsTheOldFileAndLeavesNothingHalfWritten) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "old");
  {
    const FileSizeLimit limit(1000);
    try {
      write_file_atomically(folder / "a", std::string(5000, 'x'));
      FAIL() << "nothing was thrown";
    } catch (const IoError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("free some space"));
    }
  }
  EXPECT_EQ(text_of(folder / "a"), "old");
  EXPECT_EQ(count_files(folder), 1U);
}

TEST(AtomicFile, OfAnotherWriterIsWholeOrNotThereAndNamedAsAsked) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.ply", "old");
  const auto fails = [](const std::filesystem::path& file) {
    EXPECT_EQ(file.extension(), ".ply");
    std::ofstream(file) << "half";
    throw IoError(file.string() + ": cannot be written");
  };
  try {
    write_file_atomically(folder / "a.ply", fails);
    FAIL() << "nothing was thrown";
  } catch (const IoError& error) {
    EXPECT_EQ(error.what(), (folder / "a.ply").string() + ": cannot be written");
  }
  EXPECT_EQ(text_of(folder / "a.ply"), "old");
  write_file_atomically(folder / "a.ply",
                        [](const std::filesystem::path& file) { std::ofstream(file) << "new"; });
  EXPECT_EQ(text_of(folder / "a.ply"), "new");
  write_file_atomically(folder / "a.nii.gz", [](const std::filesystem::path& file) {
    EXPECT_TRUE(file.string().ends_with(".nii.gz")) << file;
    std::ofstream(file) << "new";
  });
  EXPECT_EQ(count_files(folder), 2U);
}

TEST(AtomicFile, TakesNoDevicesPlace) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/null", folder / "device");
  EXPECT_FALSE(is_replaceable(folder / "device"));
  EXPECT_THROW(write_file_atomically(folder / "device", "x"), IoError);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "device"));
  EXPECT_FALSE(is_replaceable(folder.path())) << "a folder";
  EXPECT_FALSE(is_replaceable("/dev/null"));
  EXPECT_FALSE(is_replaceable("/dev/stdout")) << "whatever it leads to";
  EXPECT_FALSE(is_replaceable("/dev/carpus_test"));
  EXPECT_TRUE(is_replaceable(folder / "new"));
  EXPECT_TRUE(is_replaceable("new"));
}

TEST(AtomicFile, MissingFolderAndMissingFileAreNamed) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_file_atomically(folder / "no/a", "x"), IoError);
  EXPECT_THROW((void)read_file(folder / "no"), IoError);
  EXPECT_THROW((void)read_file(folder.path()), IoError);
}

TEST(UtcTime, IsWrittenAsIso8601) {
  using std::chrono::milliseconds;
  EXPECT_EQ(format_utc(std::chrono::system_clock::time_point(milliseconds(1767225599007))),
            "2025-12-31T23:59:59.007Z");
}

}  // namespace
}  // namespace carpus::records
