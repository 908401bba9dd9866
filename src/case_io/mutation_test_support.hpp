// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Damage at random, the same at every run.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/is_sanitized.hpp"
#include "core/rng.hpp"

namespace carpus::case_io::test {

namespace fs = std::filesystem;

inline std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

enum class Change { Bit, Byte, Number, Cut, Append, Remove, Double, Zeros };

inline std::string mutated(std::string bytes, Rng& rng) {
  const std::size_t size = bytes.size();
  // Half of all changes go where headers are.
  const std::size_t front = std::min<std::size_t>(size, 1500);
  const std::size_t at = rng.below(2) == 0 ? rng.below(front) : rng.below(size);
  const std::size_t length = std::min<std::size_t>(1 + rng.below(40), size - at);
  switch (static_cast<Change>(rng.below(8))) {
    case Change::Bit:
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << rng.below(8)));
      break;
    case Change::Byte:
      bytes[at] = static_cast<char>(rng.below(256));
      break;
    case Change::Number:
      for (std::size_t i = at; i < std::min(at + 4, size); ++i) {
        constexpr std::array<char, 4> kEdges{'\xFF', '\x7F', '\x00', '\x80'};
        bytes[i] = kEdges[rng.below(4)];
      }
      break;
    case Change::Cut:
      bytes.resize(at);
      break;
    case Change::Append:
      bytes.append(length, static_cast<char>(rng.below(2) == 0 ? 0 : rng.below(256)));
      break;
    case Change::Remove:
      bytes.erase(at, length);
      break;
    case Change::Double:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case Change::Zeros:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
      break;
  }
  return bytes;
}

inline bool is_failure_of_child(const std::string& words) {
  return words.find("its decoder crashed") != std::string::npos ||
         words.find("takes too long") != std::string::npos ||
         words.find("asks its decoder") != std::string::npos;
}

/// No more than so much memory in all, while it lives.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    rlimit limit = before_;
    limit.rlim_cur = std::min(limit.rlim_max, bytes);
    if (!kIsSanitized) setrlimit(RLIMIT_AS, &limit);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace carpus::case_io::test
