// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The only source of randomness: explicit, seedable, the same on every machine.
#pragma once

#include <cstdint>

namespace carpus {

/// SplitMix64 [steele2014splittable]: tiny state, passes BigCrush, and any seed is a good seed.
/// Uses integer arithmetic and one multiplication by a power of two, hence identical everywhere.
class Rng {
 public:
  explicit constexpr Rng(std::uint64_t seed) : state_(seed) {}

  /// Uniform 64-bit value.
  constexpr std::uint64_t next() noexcept {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }

  /// Uniform in [0, 1).
  constexpr double uniform() noexcept { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * uniform();
  }

  /// Uniform integer in [0, count), count > 0; the bias of the modulus is below 2^-32 for count <
  /// 2^32.
  constexpr std::uint64_t below(std::uint64_t count) noexcept { return next() % count; }

  /// Approximately normal, mean 0, deviation 1, within +-6: a sum of twelve uniforms (Irwin-Hall),
  /// because log and cos differ between mathematical libraries and this must not.
  constexpr double normal() noexcept {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  std::uint64_t state_;
};

}  // namespace carpus
