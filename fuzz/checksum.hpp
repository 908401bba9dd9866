// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The checksum behind recordings and keyframes, which a forger makes too: without it a fuzzer would
// only ever see it refused.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/state_hash.hpp"

namespace carpus::fuzz {

[[nodiscard]] inline std::vector<std::byte> with_checksum(std::span<const std::byte> bytes) {
  StateHash hash;
  hash.add_bytes(bytes);
  std::vector<std::byte> whole(bytes.begin(), bytes.end());
  for (unsigned shift = 0; shift < 64; shift += 8) {
    whole.push_back(static_cast<std::byte>(hash.value() >> shift));
  }
  return whole;
}

}  // namespace carpus::fuzz
