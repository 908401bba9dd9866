// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes a journal in a thread of its own, so that nobody who appends to it waits for a disk.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "records/detail/file_descriptor.hpp"

namespace carpus::records {

/// How far a journal has come.
struct JournalProgress {
  std::uint64_t appended = 0;  ///< mark of the last block that was appended
  std::uint64_t safe = 0;      ///< mark of the last block that is forced to disk
  std::string problem;         ///< why the disk takes nothing now, and what to do; empty when well
  std::uint64_t written_bytes = 0;
};

/// Where a journal goes on: a file that was read, up to where it was whole.
struct JournalPlace {
  std::filesystem::path file;
  detail::FileDescriptor descriptor;  ///< open for writing and locked; none: a new file
  std::uint64_t sound_size = 0;
};

class JournalWriter {
 public:
  /// After a refusal the disk is asked again this often.
  static constexpr std::chrono::milliseconds kRetry{1000};
  /// What waits for a disk that takes nothing; beyond it the journal is given up, and says so.
  static constexpr std::size_t kMostWaiting = std::size_t{64} << 20U;

  /// Never throws for a disk that fails: the progress tells. A new file is created, locked and
  /// made durable with its name by the thread; a torn end is cut away first.
  explicit JournalWriter(JournalPlace place);
  /// Tries once more to write what waits. The file stays.
  ~JournalWriter();
  JournalWriter(const JournalWriter&) = delete;
  JournalWriter& operator=(const JournalWriter&) = delete;

  /// From any thread. @param mark  what progress calls this block; not falling.
  void append(std::uint8_t kind, std::span<const std::byte> content, std::uint64_t mark);
  [[nodiscard]] JournalProgress progress() const;
  /// Whether all that was appended is on disk, waited for at most so long.
  bool wait_until_safe(std::chrono::milliseconds time) const;
  /// Its end: nothing more is written and the file is deleted.
  void remove();
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return place_.file; }

 private:
  void run();
  void write_what_waits(std::unique_lock<std::mutex>& lock);
  [[nodiscard]] bool prepare();
  [[nodiscard]] bool write(std::span<const std::byte> bytes);
  void end_thread();

  // The thread's own, but for the file's name.
  JournalPlace place_;
  bool is_ready_ = false;  ///< open, without a torn end
  bool is_named_ = false;  ///< its name is on disk

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<std::byte> waiting_;  ///< goes to sound_size
  std::uint64_t next_place_;        ///< of the next block
  JournalProgress progress_;
  bool given_up_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace carpus::records
