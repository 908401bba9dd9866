// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An open file that closes itself.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>

namespace carpus::records::detail {

class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() { reset(); }
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  [[nodiscard]] bool is_open() const noexcept { return number_ >= 0; }
  [[nodiscard]] int number() const noexcept { return number_; }
  void reset() noexcept {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }

 private:
  int number_ = -1;
};

/// All of it at this place; false with errno where the system refuses.
[[nodiscard]] inline bool write_at(int file, std::uint64_t place, std::span<const std::byte> rest) {
  while (!rest.empty()) {
    const ssize_t written = ::pwrite(file, rest.data(), rest.size(), static_cast<off_t>(place));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    if (written == 0) return errno = ENOSPC, false;
    rest = rest.subspan(static_cast<std::size_t>(written));
    place += static_cast<std::uint64_t>(written);
  }
  return true;
}

/// Puts on disk which names a folder holds: a new or renamed file is not there after a power cut
/// before that. False with errno where the system refuses.
[[nodiscard]] inline bool flush_folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const FileDescriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A file system that cannot flush a folder keeps its names by itself.
  if (!opened.is_open()) return errno == EACCES;
  return (::fsync(opened.number()) == 0 || errno == EINVAL);
}

}  // namespace carpus::records::detail
