// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that others made, opened without being believed: only regular files, so that no device and
// no pipe can hang or feed a reader for ever.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "image_formats/byte_source.hpp"

namespace carpus::case_io {

/// Surfaces and tables are far smaller; more is refused before it is read.
inline constexpr std::uint64_t kLargestWholeFile = std::uint64_t{1} << 31U;

enum class Links { Follow, Refuse };

/// A regular file, open for reading.
class RegularFile {
 public:
  /// @throws IoError where it is not there, may not be read, or is a folder, device, pipe or socket
  /// (or a link, where those are refused).
  explicit RegularFile(const std::filesystem::path& file, Links links = Links::Follow);
  ~RegularFile();
  RegularFile(RegularFile&& other) noexcept;
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;
  RegularFile& operator=(RegularFile&&) = delete;

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Its bytes for a parser, read by blocks.
class FileBytes final : public image_formats::ByteSource {
 public:
  explicit FileBytes(const RegularFile& file) : file_(file) {}
  [[nodiscard]] std::uint64_t size() const override { return file_.size(); }
  [[nodiscard]] bool read(std::uint64_t at, std::span<std::byte> to) override;

 private:
  [[nodiscard]] bool read_directly(std::uint64_t at, std::span<std::byte> to) const;

  const RegularFile& file_;
  std::uint64_t block_begins_ = 0;
  std::vector<std::byte> block_;
};

/// A file's bytes as memory, for a child to read: it needs no descriptor. Only a child may touch
/// them, because a file that shrinks meanwhile ends whoever reads behind its new end.
class MappedFile {
 public:
  /// @throws IoError where the system refuses.
  explicit MappedFile(const RegularFile& file);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  MappedFile& operator=(MappedFile&&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const noexcept { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

/// The whole content. @throws IoError as RegularFile, and where it is larger than `most`.
[[nodiscard]] std::string read_whole_file(const std::filesystem::path& file,
                                          std::uint64_t most = kLargestWholeFile,
                                          Links links = Links::Follow);

}  // namespace carpus::case_io
