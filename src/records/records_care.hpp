// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Looking after a records file: is all of it readable, what can be saved of a damaged one, a copy
// of one that is in use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace carpus::records {

struct RecordsCheck {
  std::int64_t attempts = 0;          ///< that can be read whole
  std::vector<std::string> problems;  ///< empty: the file is sound
  std::vector<std::string> waiting;   ///< rescued or running attempts beside it
};

/// Looks through the whole file. @throws IoError  it cannot be opened at all.
[[nodiscard]] RecordsCheck check_records(const std::filesystem::path& file);

struct RecordsRepair {
  std::int64_t saved = 0;          ///< attempts in the new file, with their numbers
  std::vector<std::int64_t> lost;  ///< numbers that could not be read
  std::filesystem::path damaged;   ///< where the damaged file is now
};

/// Reads attempt by attempt what can be read into a new file, which takes the old one's place.
/// @throws IoError  a station uses it, or nothing can be read or written; the file is as it was.
RecordsRepair repair_records(const std::filesystem::path& file);

/// A whole copy, while stations may go on writing. @return how many attempts are in it.
/// @throws IoError  the target is as it was.
std::int64_t back_up_records(const std::filesystem::path& file,
                             const std::filesystem::path& target);

}  // namespace carpus::records
