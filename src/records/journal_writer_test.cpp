// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/journal_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>

#include "records/atomic_file.hpp"
#include "records/journal_block.hpp"
#include "records/journals_left_behind.hpp"
#include "records/records_test_support.hpp"

namespace carpus::records {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::FileSizeLimit;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::vector<FoundJournal> found_in(const TemporaryFolder& folder) {
  std::vector<std::string> problems;
  auto found = find_journals(folder / "attempts.sqlite", problems);
  EXPECT_THAT(problems, ::testing::IsEmpty());
  return found;
}

TEST(JournalWriter, WhatWasAppendedIsFoundAndGoesOn) {
  const TemporaryFolder folder;
  const fs::path file = journal_path(folder / "attempts.sqlite", "abc");
  {
    JournalWriter writer({file, {}, 0});
    writer.append(1, bytes_of("header"), 0);
    writer.append(2, bytes_of("first"), 250);
    EXPECT_TRUE(writer.wait_until_safe(10s));
    EXPECT_EQ(writer.progress().safe, 250U);
    EXPECT_EQ(writer.progress().written_bytes, fs::file_size(file));
    EXPECT_TRUE(found_in(folder).empty()) << "it is being written";
  }
  std::ofstream(file, std::ios::app) << "half a blo";
  auto found = found_in(folder);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].content.blocks.size(), 2U);
  EXPECT_EQ(found[0].content.torn_bytes, 10U);
  EXPECT_TRUE(found_in(folder).empty()) << "who found it has it";
  {
    JournalWriter writer(std::move(found[0].place));
    writer.append(2, bytes_of("second"), 500);
    EXPECT_TRUE(writer.wait_until_safe(10s));
  }
  const JournalContent content = decode_journal(read_file(file));
  ASSERT_EQ(content.blocks.size(), 3U);
  EXPECT_EQ(content.torn_bytes, 0U);
}

TEST(JournalWriter, RemovedIsGone) {
  const TemporaryFolder folder;
  JournalWriter writer({journal_path(folder / "attempts.sqlite", "abc"), {}, 0});
  writer.append(1, bytes_of("header"), 0);
  EXPECT_TRUE(writer.wait_until_safe(10s));
  writer.remove();
  EXPECT_FALSE(fs::exists(writer.file()));
  writer.append(1, bytes_of("late"), 0);
  EXPECT_FALSE(fs::exists(writer.file()));
}

TEST(JournalWriter, AFullDiskIsToldAndWhatWaitedIsThereWhenItIsFreed) {
  const TemporaryFolder folder;
  const fs::path file = journal_path(folder / "attempts.sqlite", "abc");
  JournalWriter writer({file, {}, 0});
  writer.append(1, bytes_of("header"), 0);
  EXPECT_TRUE(writer.wait_until_safe(10s));
  const std::string large(5000, 'x');
  {
    const FileSizeLimit limit(3000);
    writer.append(2, bytes_of(large), 250);
    EXPECT_FALSE(writer.wait_until_safe(300ms));
    EXPECT_THAT(writer.progress().problem, HasSubstr("free some space"));
    EXPECT_EQ(writer.progress().safe, 0U);
  }
  writer.append(2, bytes_of("after"), 500);
  EXPECT_TRUE(writer.wait_until_safe(10s));
  EXPECT_TRUE(writer.progress().problem.empty());
  const JournalContent content = decode_journal(read_file(file));
  ASSERT_EQ(content.blocks.size(), 3U);
  EXPECT_EQ(content.blocks[1].content.size(), large.size());
}

TEST(JournalWriter, AFolderThatIsNotThereIsToldAndWaitedFor) {
  const TemporaryFolder folder;
  const fs::path file = folder / "later" / "attempts.running-x.journal";
  JournalWriter writer({file, {}, 0});
  writer.append(1, bytes_of("header"), 0);
  EXPECT_FALSE(writer.wait_until_safe(200ms));
  EXPECT_THAT(writer.progress().problem, HasSubstr("create its folder"));
  fs::create_directory(folder / "later");
  EXPECT_TRUE(writer.wait_until_safe(10s));
}

TEST(JournalWriter, WhatDoesNotFitInMemoryIsGivenUpWithAWord) {
  const TemporaryFolder folder;
  JournalWriter writer({folder / "no folder" / "x.journal", {}, 0});
  const std::vector<std::byte> much(std::size_t{16} << 20U);
  for (int i = 0; i < 5; ++i) writer.append(2, much, 1);
  EXPECT_THAT(writer.progress().problem, HasSubstr("in memory only"));
  EXPECT_FALSE(writer.wait_until_safe(10ms));
}

TEST(JournalsLeftBehind, LinksAndForeignFilesAreLeftAlone) {
  const TemporaryFolder folder;
  std::ofstream(folder / "secret") << kJournalMagic;
  fs::create_symlink(folder / "secret", folder / "attempts.running-a.journal");
  fs::create_directory(folder / "attempts.running-b.journal");
  ASSERT_EQ(::mkfifo((folder / "attempts.running-c.journal").c_str(), 0600), 0);
  std::vector<std::string> problems;
  EXPECT_TRUE(find_journals(folder / "attempts.sqlite", problems).empty());
  EXPECT_EQ(problems.size(), 3U);
}

TEST(JournalsLeftBehind, WhatNobodyCanUseIsSetAsideAndClearedLaterWithAWord) {
  const TemporaryFolder folder;
  const fs::path records = folder / "attempts.sqlite";
  std::ofstream(journal_path(records, "abc")) << "not a journal";
  auto found = found_in(folder);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(set_aside(std::move(found[0])), HasSubstr("for 30 days"));
  EXPECT_TRUE(found_in(folder).empty());
  EXPECT_TRUE(clear_old_ones(records).empty());
  const fs::path aside = journal_path(records, "abc").string() + ".unusable";
  ASSERT_TRUE(fs::exists(aside));
  fs::last_write_time(aside, fs::file_time_type::clock::now() - 31 * 24h);
  const auto words = clear_old_ones(records);
  ASSERT_EQ(words.size(), 1U);
  EXPECT_THAT(words[0], HasSubstr("deleted"));
  EXPECT_FALSE(fs::exists(aside));
}

}  // namespace
}  // namespace carpus::records
