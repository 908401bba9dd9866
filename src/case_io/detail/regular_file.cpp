// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/regular_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16U;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw IoError(file.string() + ": " + why);
}

}  // namespace

RegularFile::RegularFile(const std::filesystem::path& file, Links links) : path_(file) {
  // Without O_NONBLOCK, opening a pipe waits for whoever writes into it.
  const int flags =
      O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | (links == Links::Refuse ? O_NOFOLLOW : 0);
  descriptor_ = ::open(file.c_str(), flags);
  if (descriptor_ < 0) {
    if (errno == ELOOP) refuse(file, "is a link, which is not followed here; put the file there");
    refuse(file, std::string("cannot be opened (") + std::strerror(errno) +
                     "); check the name and the permissions");
  }
  struct stat status {};
  const bool is_regular = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (!is_regular) {
    ::close(std::exchange(descriptor_, -1));
    refuse(file, "is no regular file (a folder, device or pipe); give a file");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

RegularFile::~RegularFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

RegularFile::RegularFile(RegularFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

bool FileBytes::read_directly(std::uint64_t at, std::span<std::byte> to) const {
  while (!to.empty()) {
    const ssize_t got = ::pread(file_.descriptor(), to.data(), to.size(), static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += static_cast<std::uint64_t>(got);
    to = to.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

bool FileBytes::read(std::uint64_t at, std::span<std::byte> to) {
  if (at > size() || to.size() > size() - at) return false;
  if (to.size() >= kBlockBytes) return read_directly(at, to);
  const bool is_in_block = at >= block_begins_ && at + to.size() <= block_begins_ + block_.size();
  if (!is_in_block) {
    block_begins_ = at;
    block_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kBlockBytes, size() - at)));
    if (!read_directly(at, block_)) {
      block_.clear();
      return false;
    }
  }
  std::copy_n(block_.begin() + static_cast<std::ptrdiff_t>(at - block_begins_), to.size(),
              to.begin());
  return true;
}

MappedFile::MappedFile(const RegularFile& file) {
  if (file.size() == 0) return;
  const auto size = static_cast<std::size_t>(file.size());
  void* const place = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
  if (place == MAP_FAILED) {
    refuse(file.path(), std::string("cannot be read (") + std::strerror(errno) +
                            "); copy it to a disk of this machine");
  }
  bytes_ = {static_cast<const std::byte*>(place), size};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

std::string read_whole_file(const std::filesystem::path& file, std::uint64_t most, Links links) {
  const RegularFile opened(file, links);
  if (opened.size() > most) {
    refuse(file, "holds " + std::to_string(opened.size()) + " bytes, more than the " +
                     std::to_string(most) + " that such a file may have");
  }
  std::string content(static_cast<std::size_t>(opened.size()), '\0');
  if (!FileBytes(opened).read(0, std::as_writable_bytes(std::span(content)))) {
    refuse(file, "cannot be read whole; check the disk");
  }
  return content;
}

}  // namespace carpus::case_io
