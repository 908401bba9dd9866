// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What tells an attempt from every other, from its first tick on, on whatever station: the same
// attempt that comes from a journal, a rescue file or memory is stored once.
#pragma once

#include <cstddef>
#include <random>
#include <string>

namespace carpus::records {

/// 32 hexadecimal digits.
[[nodiscard]] inline std::string new_origin() {
  std::random_device system;
  std::string origin;
  for (int i = 0; i < 32; ++i) origin += "0123456789abcdef"[system() & 15U];
  return origin;
}

}  // namespace carpus::records
