// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/journals_left_behind.hpp"

#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <optional>
#include <utility>

namespace carpus::records {

namespace {

namespace fs = std::filesystem;

constexpr const char* kInfix = ".running-";
constexpr const char* kEnding = ".journal";
constexpr const char* kAside = ".unusable";
constexpr std::chrono::hours kKeptAside{30 * 24};

/// All that is in an open file; nothing where it cannot be read.
std::optional<std::vector<std::byte>> read_all(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0) return std::nullopt;
  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  std::size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t got = ::pread(file, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) break;
    at += static_cast<std::size_t>(got);
  }
  bytes.resize(at);
  return bytes;
}

/// Whether it is an ordinary file of this user: nobody else puts an attempt into the records.
bool is_own_file(const struct stat& status) {
  return S_ISREG(status.st_mode) && status.st_uid == ::geteuid();
}

}  // namespace

fs::path journal_path(const fs::path& records, const std::string& origin) {
  fs::path file = records;
  return file.replace_filename(records.stem().string() + kInfix + origin + kEnding);
}

std::vector<fs::path> files_beside(const fs::path& records,
                                   const std::string& infix,
                                   const std::string& ending) {
  const fs::path folder = records.has_parent_path() ? records.parent_path() : ".";
  const std::string start = records.stem().string() + infix;
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(start) && name.ends_with(ending)) files.push_back(folder / name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<FoundJournal> find_journals(const fs::path& records,
                                        std::vector<std::string>& problems) {
  std::vector<FoundJournal> found;
  for (const fs::path& file : files_beside(records, kInfix, kEnding)) {
    detail::FileDescriptor opened(
        ::open(file.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!opened.is_open()) {
      problems.push_back(file.string() + ": a running attempt was left here and cannot be read: " +
                         std::strerror(errno));
      continue;
    }
    struct stat status {};
    if (::fstat(opened.number(), &status) != 0 || !is_own_file(status)) {
      problems.push_back(file.string() + ": not this user's own file; it is left alone");
      continue;
    }
    if (::flock(opened.number(), LOCK_EX | LOCK_NB) != 0) continue;  // another station's
    const auto bytes = read_all(opened.number());
    if (!bytes) {
      problems.push_back(file.string() + ": a running attempt was left here and cannot be read: " +
                         std::strerror(errno));
      continue;
    }
    JournalContent content = decode_journal(*bytes);
    const std::uint64_t sound_size = content.sound_size;
    found.push_back({{file, std::move(opened), sound_size},
                     std::move(content),
                     std::chrono::system_clock::from_time_t(status.st_mtim.tv_sec)});
  }
  return found;
}

std::string set_aside(FoundJournal journal) {
  const fs::path aside = journal.place.file.string() + kAside;
  std::error_code error;
  fs::rename(journal.place.file, aside, error);
  if (error) return "it stays at " + journal.place.file.string() + ": " + error.message();
  fs::last_write_time(aside, fs::file_time_type::clock::now(), error);
  return "it is kept as " + aside.string() + " for 30 days";
}

std::vector<std::string> clear_old_ones(const fs::path& records) {
  std::vector<std::string> words;
  for (const fs::path& file : files_beside(records, kInfix, std::string(kEnding) + kAside)) {
    std::error_code error;
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file, error);
    if (error || age < kKeptAside || !fs::remove(file, error)) continue;
    words.push_back(file.string() + ": an attempt that could not be used for 30 days is deleted");
  }
  return words;
}

}  // namespace carpus::records
