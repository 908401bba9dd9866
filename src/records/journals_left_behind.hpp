// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where the journals of running attempts lie: beside the records, told from finished attempts by
// their name, "attempts.running-<stamp>.journal". One that nobody writes any more was left behind
// by a program that did not end in order.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "records/journal_block.hpp"
#include "records/journal_writer.hpp"

namespace carpus::records {

/// A name for the journal of an attempt. @param origin  of the attempt: no two have the same.
[[nodiscard]] std::filesystem::path journal_path(const std::filesystem::path& records,
                                                 const std::string& origin);

/// A journal that nobody writes, locked from now on for who found it.
struct FoundJournal {
  JournalPlace place;
  JournalContent content;
  std::chrono::system_clock::time_point last_written;
};

/// Those beside these records that are this user's own files and in no other program's use.
/// What cannot be read is not among them and said in `problems`.
[[nodiscard]] std::vector<FoundJournal> find_journals(const std::filesystem::path& records,
                                                      std::vector<std::string>& problems);

/// Files of `records`' folder whose names are `<stem><infix>…<ending>`, in their names' order.
[[nodiscard]] std::vector<std::filesystem::path> files_beside(const std::filesystem::path& records,
                                                              const std::string& infix,
                                                              const std::string& ending);

/// Puts a journal that nobody can use aside under another name, for 30 days; those that lie aside
/// for longer are deleted. What was done is said in words.
[[nodiscard]] std::string set_aside(FoundJournal journal);
[[nodiscard]] std::vector<std::string> clear_old_ones(const std::filesystem::path& records);

}  // namespace carpus::records
