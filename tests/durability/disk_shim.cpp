// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "disk_shim.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace carpus::durability {

namespace {

using Bytes = std::vector<char>;
using Inode = ::ino_t;

constexpr std::size_t kPage = 4096;

/// All that the shim knows; made when first used, never destroyed: libraries write until the end.
struct Disk {
  std::mutex mutex;
  bool is_on = false;
  DiskPlan plan;
  std::string folder;
  std::uint64_t changes = 0;
  std::map<Inode, Bytes> flushed;
  std::map<std::string, Inode> flushed_names;
};

Disk& disk() {
  static auto* const made = new Disk;
  return *made;
}

/// Where an open file lies; empty for what is no file of the folder.
std::string path_of(int file) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const auto size = ::readlink(link.c_str(), path.data(), path.size());
  return size > 0 ? std::string(path.data(), static_cast<std::size_t>(size)) : std::string();
}

bool is_watched(const std::string& path) {
  return disk().is_on && path.starts_with(disk().folder + "/");
}
bool is_watched(int file) { return disk().is_on && is_watched(path_of(file)); }

Bytes content_of(int file) {
  struct stat status {};
  ::fstat(file, &status);
  Bytes bytes(static_cast<std::size_t>(status.st_size));
  std::size_t at = 0;
  while (at < bytes.size()) {
    const auto got = ::syscall(SYS_pread64, file, bytes.data() + at, bytes.size() - at, at);
    if (got <= 0) break;
    at += static_cast<std::size_t>(got);
  }
  bytes.resize(at);
  return bytes;
}

std::map<std::string, Inode> names_now() {
  std::map<std::string, Inode> names;
  DIR* const folder = ::opendir(disk().folder.c_str());
  while (const dirent* entry = ::readdir(folder)) {
    if (entry->d_name[0] != '.') names[entry->d_name] = entry->d_ino;
  }
  ::closedir(folder);
  return names;
}

/// The flushed bytes with any pages of the newer ones.
Bytes with_some_pages(Bytes old, const Bytes& now, std::mt19937_64& random) {
  old.resize(old.size() + random() % (now.size() > old.size() ? now.size() - old.size() + 1 : 1));
  for (std::size_t page = 0; page < std::min(old.size(), now.size()); page += kPage) {
    if (random() % 2 == 0) continue;
    const std::size_t end = std::min({page + kPage, old.size(), now.size()});
    std::copy(now.begin() + static_cast<std::ptrdiff_t>(page),
              now.begin() + static_cast<std::ptrdiff_t>(end),
              old.begin() + static_cast<std::ptrdiff_t>(page));
  }
  return old;
}

void write_after(const std::string& name, const Bytes& bytes) {
  const std::string path = disk().plan.after / name;
  const auto file = static_cast<int>(
      ::syscall(SYS_openat, AT_FDCWD, path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600));
  std::size_t at = 0;
  while (at < bytes.size()) {
    const auto written = ::syscall(SYS_write, file, bytes.data() + at, bytes.size() - at);
    if (written <= 0) break;
    at += static_cast<std::size_t>(written);
  }
  ::close(file);
}

/// Leaves what a disk has after a power cut, and ends the process without another word.
[[noreturn]] void cut_power() {
  Disk& d = disk();
  if (d.plan.on_cut) d.plan.on_cut();
  std::mt19937_64 random(d.plan.seed);
  const auto now = names_now();
  std::map<std::string, Inode> names = d.flushed_names;
  if (d.plan.unflushed == Unflushed::SomePages) {
    for (const auto& [name, inode] : now) {
      if (random() % 2 == 0) names[name] = inode;
    }
  }
  for (const auto& [name, inode] : names) {
    Bytes bytes = d.flushed[inode];
    const auto still = now.find(name);
    if (d.plan.unflushed == Unflushed::SomePages && still != now.end() && still->second == inode) {
      const auto file = static_cast<int>(
          ::syscall(SYS_openat, AT_FDCWD, (d.folder + "/" + name).c_str(), O_RDONLY));
      if (file >= 0) bytes = with_some_pages(std::move(bytes), content_of(file), random);
    }
    write_after(name, bytes);
  }
  ::_exit(kPowerCut);
}

/// Whether this change of the folder takes place. Call with the lock held.
bool may_change() {
  Disk& d = disk();
  ++d.changes;
  if (d.plan.cut_at != 0 && d.changes >= d.plan.cut_at) cut_power();
  return d.plan.fail_at == 0 ||
         (d.plan.fails_for_good ? d.changes < d.plan.fail_at : d.changes != d.plan.fail_at);
}

/// Does what the system call does unless it is the one that fails.
template <typename Call>
auto change(bool watched, int error, Call&& call) -> decltype(call()) {
  if (!watched) return call();
  const std::lock_guard lock(disk().mutex);
  if (!may_change()) {
    errno = error;
    return -1;
  }
  return call();
}

int flush(int file) {
  struct stat status {};
  const bool is_folder = ::fstat(file, &status) == 0 && S_ISDIR(status.st_mode);
  const std::string path = path_of(file);
  const bool watched = disk().is_on && (is_watched(path) || path == disk().folder);
  return change(watched, EIO, [&] {
    // Really flushing costs time and proves nothing here.
    if (!watched) return static_cast<int>(::syscall(SYS_fdatasync, file));
    if (is_folder) {
      disk().flushed_names = names_now();
    } else {
      disk().flushed[status.st_ino] = content_of(file);
    }
    return 0;
  });
}

int open_file(int folder, const char* path, int flags, mode_t mode) {
  const bool creates = (flags & O_CREAT) != 0 && is_watched(std::string(path));
  struct stat status {};
  const bool is_new = creates && ::lstat(path, &status) != 0;
  return change(is_new, ENOSPC, [&] {
    const auto file = static_cast<int>(::syscall(SYS_openat, folder, path, flags, mode));
    // A number that a deleted file had is another file's now.
    if (is_new && file >= 0 && ::fstat(file, &status) == 0) disk().flushed.erase(status.st_ino);
    return file;
  });
}

}  // namespace

void begin(const DiskPlan& plan) {
  const std::lock_guard lock(disk().mutex);
  disk().plan = plan;
  disk().folder = std::filesystem::canonical(plan.folder).string();
  disk().is_on = true;
  disk().flushed_names = names_now();
  for (const auto& [name, inode] : disk().flushed_names) {
    const auto file = static_cast<int>(
        ::syscall(SYS_openat, AT_FDCWD, (disk().folder + "/" + name).c_str(), O_RDONLY));
    disk().flushed[inode] = content_of(file);
    ::close(file);
  }
}

void mend() {
  const std::lock_guard lock(disk().mutex);
  disk().plan.fail_at = 0;
}

std::uint64_t changes() {
  const std::lock_guard lock(disk().mutex);
  return disk().changes;
}

}  // namespace carpus::durability

// The C library's functions, as every other library of this program finds them.
using carpus::durability::change;
using carpus::durability::flush;
using carpus::durability::is_watched;
using carpus::durability::open_file;

extern "C" {

ssize_t write(int file, const void* bytes, size_t size) {
  return change(is_watched(file), ENOSPC,
                [&] { return static_cast<ssize_t>(::syscall(SYS_write, file, bytes, size)); });
}
ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  return change(is_watched(file), ENOSPC, [&] {
    return static_cast<ssize_t>(::syscall(SYS_pwrite64, file, bytes, size, at));
  });
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  return pwrite(file, bytes, size, at);
}
int ftruncate(int file, off_t size) noexcept {
  return change(is_watched(file), ENOSPC,
                [&] { return static_cast<int>(::syscall(SYS_ftruncate, file, size)); });
}
int ftruncate64(int file, off64_t size) noexcept { return ftruncate(file, size); }
int fsync(int file) { return flush(file); }
int fdatasync(int file) { return flush(file); }
int rename(const char* from, const char* to) noexcept {
  return change(is_watched(std::string(to)), ENOSPC, [&] {
    return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
  });
}
int unlink(const char* path) noexcept {
  return change(is_watched(std::string(path)), EIO,
                [&] { return static_cast<int>(::syscall(SYS_unlinkat, AT_FDCWD, path, 0)); });
}
int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const auto mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_file(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const auto mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_file(AT_FDCWD, path, flags, mode);
}

}  // extern "C"
