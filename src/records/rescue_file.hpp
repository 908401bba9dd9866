// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where an attempt goes that the records refuse: a records file of its own, "attempts.rescued-….
// sqlite" beside them or in the folder for temporary files, from which it is taken back.
#pragma once

#include <filesystem>
#include <vector>

#include "records/attempt.hpp"
#include "records/attempt_store.hpp"

namespace carpus::records {

/// Writes one; the empty path where that is impossible too.
[[nodiscard]] std::filesystem::path rescue(const std::filesystem::path& records,
                                           const Attempt& attempt);

/// This user's own rescue files of these records, in both places.
[[nodiscard]] std::vector<std::filesystem::path> rescue_files(const std::filesystem::path& records);

/// Stores what is in a rescue file and deletes it; an attempt that is stored already is not stored
/// twice. @return their numbers; none when there is nothing in it yet.
/// @throws IoError  the records still refuse, or the file cannot be read; it stays.
std::vector<std::int64_t> take_back(AttemptStore& store, const std::filesystem::path& rescue_file);

}  // namespace carpus::records
