// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers to bytes and back, little-endian, for recordings and keyframes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carpus::simulation::detail {

class Writer {
 public:
  Writer() = default;
  /// Goes on behind these.
  explicit Writer(std::vector<std::byte>&& begun) : bytes_(std::move(begun)) {}

  /// The low `size` bytes of a value.
  void put(std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      bytes_.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
  }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value), 8); }
  /// Its size in two bytes, then its bytes; longer texts are cut.
  void put(std::string_view text) {
    text = text.substr(0, UINT16_MAX);
    put(text.size(), 2);
    for (const char c : text) bytes_.push_back(static_cast<std::byte>(c));
  }
  void put(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  /// Seven bits a byte, small numbers of either sign in few.
  void put_signed(std::int64_t value) {
    auto bits =
        (static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value < 0 ? -1 : 0);
    while (bits >= 0x80U) {
      bytes_.push_back(static_cast<std::byte>(bits | 0x80U));
      bits >>= 7U;
    }
    bytes_.push_back(static_cast<std::byte>(bits));
  }
  [[nodiscard]] std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads forward; the first read beyond the end spoils it, and every later one.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::uint64_t get(std::size_t size) {
    std::uint64_t value = 0;
    if (!take(size)) return 0;
    for (std::size_t i = 0; i < size; ++i) {
      value |= static_cast<std::uint64_t>(bytes_[at_ - size + i]) << (8 * i);
    }
    return value;
  }
  [[nodiscard]] double get_double() { return std::bit_cast<double>(get(8)); }
  [[nodiscard]] std::string get_text() {
    const auto size = static_cast<std::size_t>(get(2));
    if (!take(size)) return {};
    std::string text(size, '\0');
    if (size > 0) std::memcpy(text.data(), bytes_.data() + at_ - size, size);
    return text;
  }
  [[nodiscard]] std::span<const std::byte> get_bytes(std::size_t size) {
    return take(size) ? bytes_.subspan(at_ - size, size) : std::span<const std::byte>{};
  }
  [[nodiscard]] std::int64_t get_signed() {
    std::uint64_t bits = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint64_t byte = get(1);
      bits |= (byte & 0x7FU) << shift;
      if ((byte & 0x80U) == 0) {
        return static_cast<std::int64_t>(bits >> 1U) ^ -static_cast<std::int64_t>(bits & 1U);
      }
    }
    spoilt_ = true;
    return 0;
  }
  [[nodiscard]] bool is_spoilt() const { return spoilt_; }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::span<const std::byte> rest() const { return bytes_.subspan(at_); }

 private:
  bool take(std::size_t size) {
    if (spoilt_ || bytes_.size() - at_ < size) {
      spoilt_ = true;
      return false;
    }
    at_ += size;
    return true;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool spoilt_ = false;
};

}  // namespace carpus::simulation::detail
