// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// FNV-1a over the bytes of plain values: the fingerprint that replay must reproduce. Not a
// cryptographic hash; it tells whether two runs went the same way.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace carpus {

class StateHash {
 public:
  /// Adds an integer, least significant byte first on every machine.
  constexpr void add(std::uint64_t value) noexcept {
    for (unsigned shift = 0; shift < 64; shift += 8) mix(static_cast<std::uint8_t>(value >> shift));
  }
  /// Adds the exact bits of a number; -0 and +0 count as the same.
  constexpr void add(double value) noexcept {
    add(std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value));
  }
  constexpr void add_bytes(std::span<const std::byte> bytes) noexcept {
    for (const std::byte b : bytes) mix(static_cast<std::uint8_t>(b));
  }
  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return hash_; }

 private:
  constexpr void mix(std::uint8_t byte) noexcept { hash_ = (hash_ ^ byte) * 0x100000001B3ULL; }
  std::uint64_t hash_ = 0xCBF29CE484222325ULL;
};

}  // namespace carpus
