// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Where a parser takes its bytes from: a file of any length, or memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace carpus::image_formats {

/// A part of a source.
struct ByteRange {
  std::uint64_t begins = 0;
  std::uint64_t bytes = 0;
};

class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Fills `to` from position `at`; false where not all of it is there.
  [[nodiscard]] virtual bool read(std::uint64_t at, std::span<std::byte> to) = 0;
};

class MemoryBytes final : public ByteSource {
 public:
  explicit MemoryBytes(std::span<const std::byte> bytes) : bytes_(bytes) {}
  [[nodiscard]] std::uint64_t size() const override { return bytes_.size(); }
  [[nodiscard]] bool read(std::uint64_t at, std::span<std::byte> to) override {
    if (at > bytes_.size() || to.size() > bytes_.size() - at) return false;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at), to.size(), to.begin());
    return true;
  }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace carpus::image_formats
