// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/atomic_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "case_io/detail/disk_space.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

/// Without a trailing slash, so that it has a name and a parent.
fs::path normalized(const fs::path& p) {
  fs::path n = fs::absolute(p).lexically_normal();
  return n.has_filename() ? n : n.parent_path();
}

void sync_to_disk(const fs::path& p) {
  const int fd = ::open(p.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw_cannot_write(p);
  const int outcome = ::fsync(fd);
  ::close(fd);
  if (outcome != 0) throw_cannot_write(p);
}

bool holds_something(const fs::path& p) {
  std::error_code error;
  return fs::is_directory(p, error) ? !fs::is_empty(p, error) : fs::exists(p, error);
}

/// Puts `staging` in the place of an existing folder; true where the two were exchanged.
bool exchange(const fs::path& staging, const fs::path& target) {
  if (::renameat2(AT_FDCWD, staging.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) {
    return true;
  }
  if (errno != EINVAL && errno != ENOSYS) throw_cannot_write(target);
  return false;
}

constexpr std::string_view kOld = "-old";

/// What staging folders of this target are called, before the number of their process.
std::string staging_prefix(const fs::path& target) {
  return "." + target.filename().string() + ".partial-";
}

/// Whether a program writes into it: one whose number means nothing here, in a container of its
/// own, still holds its lock.
bool is_held(const fs::path& folder) {
  const int held = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (held < 0) return true;  // whatever it is, it is none of ours
  const bool is_free = ::flock(held, LOCK_EX | LOCK_NB) == 0;
  ::close(held);
  return !is_free;
}

/// Clears what programs left that were killed while they wrote to this target. One that was killed
/// between two renames had put the old folder beside: it goes back.
void clear_what_was_left(const fs::path& target) {
  const std::string prefix = staging_prefix(target);
  std::error_code error;
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(target.parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    std::string_view number = std::string_view(name).substr(prefix.size());
    if (number.ends_with(kOld)) number.remove_suffix(kOld.size());
    pid_t process = 0;
    const auto [end, problem] =
        std::from_chars(number.data(), number.data() + number.size(), process);
    const bool is_ours = problem == std::errc() && end == number.data() + number.size();
    const bool is_gone = is_ours && process > 0 && ::kill(process, 0) != 0 && errno == ESRCH;
    if (is_gone && !is_held(entry.path())) left.push_back(entry.path());
  }
  for (const fs::path& each : left) {
    if (each.string().ends_with(kOld) && !fs::exists(target, error)) {
      fs::rename(each, target, error);
    } else {
      fs::remove_all(each, error);
    }
  }
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path target, Overwrite overwrite) : target_(normalized(target)) {
  std::error_code error;
  clear_what_was_left(target_);
  if (fs::exists(target_, error) && !fs::is_directory(target_, error)) {
    throw IoError(target_.string() + ": is a file; choose another folder");
  }
  if (overwrite == Overwrite::Refuse && holds_something(target_)) {
    throw IoError(target_.string() +
                  ": is there already and not empty; choose another folder, or replace it with "
                  "--force");
  }
  fs::create_directories(target_.parent_path(), error);
  staging_ = target_.parent_path() / (staging_prefix(target_) + std::to_string(::getpid()));
  fs::remove_all(staging_, error);
  if (!fs::create_directory(staging_, error)) throw_cannot_write(staging_);
  lock_ = ::open(staging_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) (void)::flock(lock_, LOCK_EX | LOCK_NB);  // where there are no locks, without
}

AtomicFolder::~AtomicFolder() {
  if (lock_ >= 0) ::close(lock_);
  if (is_committed_) return;
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void AtomicFolder::commit() {
  for (const auto& entry : fs::recursive_directory_iterator(staging_)) sync_to_disk(entry.path());
  sync_to_disk(staging_);
  std::error_code error;
  if (!fs::exists(target_, error) || fs::is_empty(target_, error)) {
    fs::rename(staging_, target_, error);  // replaces an empty folder too
    if (error) throw_cannot_write(target_);
  } else if (exchange(staging_, target_)) {
    fs::remove_all(staging_, error);  // now the old one
  } else {  // a file system without exchange: the old one waits beside until the new one is there
    const fs::path old = staging_.string() + std::string(kOld);
    fs::rename(target_, old, error);
    if (error) throw_cannot_write(target_);
    fs::rename(staging_, target_, error);
    if (error) {
      std::error_code ignored;
      fs::rename(old, target_, ignored);
      throw_cannot_write(target_);
    }
    fs::remove_all(old, error);
  }
  is_committed_ = true;
  sync_to_disk(target_.parent_path());
}

}  // namespace carpus::case_io
