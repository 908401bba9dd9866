// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/rescue_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <system_error>

#include "core/error.hpp"
#include "core/hexadecimal.hpp"
#include "core/state_hash.hpp"
#include "records/detail/file_descriptor.hpp"
#include "records/journals_left_behind.hpp"

namespace carpus::records {

namespace {

namespace fs = std::filesystem;

constexpr const char* kInfix = ".rescued-";
constexpr const char* kEnding = ".sqlite";

/// An attempt from before attempts had an origin gets one of what it holds: it too is stored once.
std::string origin_of(const AttemptSummary& summary) {
  if (!summary.origin.empty()) return summary.origin;
  StateHash hash;
  for (const std::string* text : {&summary.started_at, &summary.ended_at, &summary.trainee,
                                  &summary.case_fingerprint, &summary.final_hash}) {
    hash.add_bytes(std::as_bytes(std::span(text->data(), text->size())));
    hash.add(std::uint64_t{text->size()});
  }
  return "rescued-" + hexadecimal(hash.value());
}

/// A name that says when the attempt was made: "attempts.rescued-20260131T120000000Z-1f….sqlite".
std::string rescue_name(const AttemptSummary& summary) {
  std::string stamp;
  for (const char c : summary.ended_at) {
    if ((c >= '0' && c <= '9') || c == 'T' || c == 'Z') stamp += c;
  }
  return stamp + "-" + origin_of(summary) + kEnding;
}

/// In the folder for temporary files, records of several places may have the same name.
std::string infix_elsewhere(const fs::path& records) {
  std::error_code ignored;
  const std::string place = fs::absolute(records, ignored).string();
  StateHash hash;
  hash.add_bytes(std::as_bytes(std::span(place.data(), place.size())));
  return "." + hexadecimal(hash.value()) + kInfix;
}

/// Makes an empty file that nobody put there before; false where that cannot be done.
bool create(const fs::path& file) {
  constexpr int kNew = O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  return detail::FileDescriptor(::open(file.c_str(), kNew, 0600)).is_open();
}

bool is_own_file(const fs::path& file) {
  struct stat status {};
  return ::lstat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
         status.st_uid == ::geteuid();
}

void remove_whole(const fs::path& file) {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
    fs::remove(file.string() + suffix, ignored);
  }
}

}  // namespace

fs::path rescue(const fs::path& records, const Attempt& attempt) {
  std::error_code ignored;
  const fs::path beside = records.has_parent_path() ? records.parent_path() : ".";
  const std::string stem = records.stem().string();
  const std::string name = rescue_name(attempt.summary);
  for (const fs::path& file :
       {beside / (stem + kInfix + name),
        fs::temp_directory_path(ignored) / (stem + infix_elsewhere(records) + name)}) {
    if (!create(file)) continue;
    try {
      AttemptStore(file).save(attempt);
      if (detail::flush_folder_of(file)) return file;
    } catch (const Error&) {
      remove_whole(file);
    }
  }
  return {};
}

std::vector<fs::path> rescue_files(const fs::path& records) {
  std::error_code ignored;
  std::vector<fs::path> files = files_beside(records, kInfix, kEnding);
  const fs::path elsewhere = fs::temp_directory_path(ignored) / records.filename();
  for (fs::path& file : files_beside(elsewhere, infix_elsewhere(records), kEnding)) {
    files.push_back(std::move(file));
  }
  // What another user put there is no attempt of these records.
  std::erase_if(files, [](const fs::path& file) { return !is_own_file(file); });
  return files;
}

std::vector<std::int64_t> take_back(AttemptStore& store, const fs::path& rescue_file) {
  std::vector<std::int64_t> ids;
  {
    const AttemptStore rescued(rescue_file);
    for (const AttemptSummary& summary : rescued.list()) {
      std::optional<Attempt> attempt = rescued.find(summary.id);
      if (!attempt) continue;
      attempt->summary.origin = origin_of(attempt->summary);
      ids.push_back(store.save(*attempt));
    }
  }
  // One without attempts may just be being written.
  if (!ids.empty()) remove_whole(rescue_file);
  return ids;
}

}  // namespace carpus::records
