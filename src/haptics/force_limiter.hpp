// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The last word before a device: no force beyond its limit, none that is not finite.
#pragma once

#include <cstdint>

#include "geometry/vec3.hpp"

namespace carpus::haptics {

/// Real-time.
class ForceLimiter {
 public:
  explicit ForceLimiter(double most_n) noexcept : most_n_(most_n) {}

  /// @return the force, as long as it may be, in its own direction; zero where it is not finite.
  [[nodiscard]] Vec3 limited(const Vec3& force) noexcept;
  /// The greatest magnitude that a device may be told: within `wished` and this one's.
  [[nodiscard]] double limit_n(double wished) noexcept;

  /// Forces and limits that were not finite, and forces that were too long.
  [[nodiscard]] std::uint64_t faults() const noexcept { return faults_; }
  [[nodiscard]] std::uint64_t limited_count() const noexcept { return limited_count_; }

 private:
  double most_n_;
  std::uint64_t faults_ = 0;
  std::uint64_t limited_count_ = 0;
};

}  // namespace carpus::haptics
