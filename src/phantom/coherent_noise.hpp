// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Smooth random texture: value noise on a hashed lattice, the same for a seed whatever is asked
// first. Gives bone its trabecular texture, fracture faces their relief and soft tissue its
// patches.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/rng.hpp"
#include "geometry/vec3.hpp"

namespace carpus::phantom {

/// Random value in [-1, 1) of a lattice point.
[[nodiscard]] inline double lattice_value(std::int64_t x,
                                          std::int64_t y,
                                          std::int64_t z,
                                          std::uint64_t seed) noexcept {
  std::uint64_t h = seed;
  for (const std::int64_t v : {x, y, z}) {  // FNV steps, then SplitMix to spread the bits
    h = (h ^ static_cast<std::uint64_t>(v)) * 0x100000001B3ULL;
    h ^= h >> 29U;
  }
  return 2.0 * Rng(h).uniform() - 1.0;
}

/// Noise in [-1, 1] that varies over about `scale_mm`; twice continuously differentiable.
[[nodiscard]] inline double coherent_noise(const Vec3& point,
                                           double scale_mm,
                                           std::uint64_t seed) noexcept {
  const Vec3 p = point / scale_mm;
  const Vec3 floor{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 t = p - floor;
  const auto fade = [](double a) { return a * a * a * (a * (a * 6 - 15) + 10); };
  const Vec3 f{fade(t.x), fade(t.y), fade(t.z)};
  const auto x = static_cast<std::int64_t>(floor.x);
  const auto y = static_cast<std::int64_t>(floor.y);
  const auto z = static_cast<std::int64_t>(floor.z);
  const auto row = [&](std::int64_t j, std::int64_t k) {
    return lattice_value(x, y + j, z + k, seed) * (1 - f.x) +
           lattice_value(x + 1, y + j, z + k, seed) * f.x;
  };
  const auto slice = [&](std::int64_t k) { return row(0, k) * (1 - f.y) + row(1, k) * f.y; };
  return slice(0) * (1 - f.z) + slice(1) * f.z;
}

/// 0 below `low`, 1 above `high`, smooth between.
[[nodiscard]] inline double smooth_step(double low, double high, double v) noexcept {
  const double t = v <= low ? 0.0 : (v >= high ? 1.0 : (v - low) / (high - low));
  return t * t * (3 - 2 * t);
}

}  // namespace carpus::phantom
