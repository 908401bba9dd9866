// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/atomic_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "records/detail/file_advice.hpp"
#include "records/detail/file_descriptor.hpp"

namespace carpus::records {

namespace {

/// By which a writer chooses the format: the extension, and what is packed too: ".nii.gz".
std::string ending_of(const std::filesystem::path& file) {
  const std::string last = file.extension().string();
  return last == ".gz" ? file.stem().extension().string() + last : last;
}

/// A file under a temporary name that vanishes unless it is renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target)
      : target_(target), name_(target.string() + ".XXXXXX" + ending_of(target)) {
    if (!is_replaceable(target)) {
      throw IoError(target.string() + ": is a device or no plain file; give another name");
    }
    descriptor_ = ::mkstemps(name_.data(), static_cast<int>(ending_of(target).size()));
    if (descriptor_ < 0) fail("cannot create");
    // mkstemps makes it private; other users may read it like any file that a program writes.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    if (::fchmod(descriptor_, 0666 & ~mask) != 0) {
      const int error = errno;
      discard();
      errno = error;
      fail("cannot set the permissions of");
    }
  }
  ~TemporaryFile() { discard(); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::byte> content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail("cannot write");
      content = content.subspan(static_cast<std::size_t>(written));
    }
  }

  void flush() {
    if (::fsync(descriptor_) != 0) fail("cannot write");
  }

  [[nodiscard]] const std::string& name() const { return name_; }

  void rename_to_target() {
    if (::rename(name_.c_str(), target_.c_str()) != 0) fail("cannot write");
    name_.clear();
    // Until then a power cut may leave what was there before.
    if (!detail::flush_folder_of(target_)) fail("cannot put on disk");
  }

 private:
  void discard() noexcept {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  [[noreturn]] void fail(const char* what) {
    const int error = errno;
    throw IoError(target_.string() + ": " + what + " the file: " + std::strerror(error) + "; " +
                  detail::advice(error));
  }

  std::filesystem::path target_;
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace

bool is_replaceable(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_status there = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) return false;
  // /dev/stdout is a link to a plain file where that is what it was led into.
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file).parent_path(),
                                           ignored) != "/dev";
}

void write_file_atomically(const std::filesystem::path& file, std::span<const std::byte> content) {
  TemporaryFile temporary(file);
  temporary.write(content);
  temporary.flush();
  temporary.rename_to_target();
}

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  write_file_atomically(file, std::as_bytes(std::span(content.data(), content.size())));
}

void write_file_atomically(const std::filesystem::path& file,
                           const std::function<void(const std::filesystem::path&)>& write) {
  TemporaryFile temporary(file);
  try {
    write(temporary.name());
  } catch (const IoError& error) {  // the temporary name says nothing to who reads it
    std::string text = error.what();
    const std::size_t at = text.find(temporary.name());
    if (at != std::string::npos) text.replace(at, temporary.name().size(), file.string());
    throw IoError(text);
  }
  temporary.flush();
  temporary.rename_to_target();
}

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream || std::filesystem::is_directory(file)) {
    throw IoError(file.string() + ": no such file, or it cannot be read");
  }
  std::vector<std::byte> content(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(content.data()),
              static_cast<std::streamsize>(content.size()));
  if (!stream) throw IoError(file.string() + ": cannot be read to its end");
  return content;
}

}  // namespace carpus::records
