// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/force_limiter.hpp"

#include <algorithm>

namespace carpus::haptics {

Vec3 ForceLimiter::limited(const Vec3& force) noexcept {
  const double size = length(force);
  if (!std::isfinite(size)) {
    ++faults_;
    return {};
  }
  if (size <= most_n_) return force;
  ++limited_count_;
  return force * (most_n_ / size);
}

double ForceLimiter::limit_n(double wished) noexcept {
  if (!std::isfinite(wished)) {
    ++faults_;
    return 0;
  }
  return std::clamp(wished, 0.0, most_n_);
}

}  // namespace carpus::haptics
