// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a parser may do with any bytes: accept, or refuse in words. Anything else ends the run.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <string>

#include "core/error.hpp"

namespace carpus::fuzz {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// How often something was read: a short run whose seeds are all refused tries little.
inline std::size_t accepted = 0;

/// True where `read` accepted; a refusal must name the file first.
template <typename Read>
bool reads_or_refuses(const std::string& file, const Read& read) {
  try {
    read();
    ++accepted;
    return true;
  } catch (const Error& error) {
    require(std::string(error.what()).starts_with(file));
  }
  return false;
}

}  // namespace carpus::fuzz
