// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Two doubles at a time, in the vectors that every target has (SSE2, NEON, WebAssembly), each lane
// with the arithmetic of a double: same bytes, half the instructions.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>

namespace carpus::hull {

using Pair = double __attribute__((vector_size(16)));
using PairMask = std::int64_t __attribute__((vector_size(16)));

inline Pair both(double value) { return Pair{value, value}; }
inline Pair load_pair(const double* two) {
  Pair pair;
  std::memcpy(&pair, two, sizeof pair);
  return pair;
}
inline void store_pair(double* two, Pair pair) { std::memcpy(two, &pair, sizeof pair); }
inline Pair chosen(PairMask mask, Pair yes, Pair no) {
  return reinterpret_cast<Pair>((mask & reinterpret_cast<PairMask>(yes)) |
                                (~mask & reinterpret_cast<PairMask>(no)));
}
/// The lesser; where either is NaN, b.
inline Pair lesser(Pair a, Pair b) { return a < b ? a : b; }
inline Pair greater(Pair a, Pair b) { return a > b ? a : b; }
inline Pair magnitude(Pair a) {
  constexpr std::int64_t kAllButSign = std::numeric_limits<std::int64_t>::max();
  return reinterpret_cast<Pair>(reinterpret_cast<PairMask>(a) & PairMask{kAllButSign, kAllButSign});
}

}  // namespace carpus::hull
