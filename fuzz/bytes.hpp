// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The input of a fuzz target, taken byte by byte; zeros where it has ended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace carpus::fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  [[nodiscard]] std::size_t left() const { return size_; }
  std::uint8_t byte() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  /// Below `count`, which is at most 256.
  unsigned below(std::size_t count) { return byte() % static_cast<unsigned>(count); }
  double any_double() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8U | byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace carpus::fuzz
