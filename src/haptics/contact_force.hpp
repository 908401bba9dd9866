// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Force on the hand from the proxy method [zilles1995godobject]: a spring and a damper between the
// place where the hand is and the place where the instrument may be; and the limiter, which comes
// last in every tick.
#pragma once

#include <cmath>
#include <cstdint>

#include "geometry/vec3.hpp"

namespace carpus::haptics {

/// What a cheap device renders stably on cartilage: 1 to 3 N/mm [clinical: B11 E].
inline constexpr double kContactStiffnessNPerMm = 2.0;
inline constexpr double kContactDampingNSPerMm = 0.003;

/// Above the greatest thrust that bone asks for (B11: 40 N); a device has its own, lower limit.
inline constexpr double kForceLimitN = 40.0;

/// Spring from hand to proxy with damping of the hand's motion.
/// @param proxy, hand  same frame [mm]; `hand_velocity` [mm/s].
[[nodiscard]] inline Vec3 contact_force_n(const Vec3& proxy,
                                          const Vec3& hand,
                                          const Vec3& hand_velocity) noexcept {
  const Vec3 spring = (proxy - hand) * kContactStiffnessNPerMm;
  const double stretch = length(spring);
  if (!(stretch > 0)) return {};
  // Damping acts along the spring only, and never turns its push into a pull.
  const Vec3 along = spring / stretch;
  const double damping = -kContactDampingNSPerMm * dot(hand_velocity, along);
  const double total = stretch + damping;
  return total > 0 ? along * total : Vec3{};
}

/// Limits the magnitude; a force that is not finite becomes zero and is counted.
class ForceLimiter {
 public:
  [[nodiscard]] Vec3 limited(const Vec3& force_n) noexcept {
    if (!is_finite(force_n)) {
      ++faults_;
      return {};
    }
    const double magnitude = length(force_n);
    if (!std::isfinite(magnitude)) {
      ++faults_;
      return {};
    }
    return magnitude > kForceLimitN ? force_n * (kForceLimitN / magnitude) : force_n;
  }
  [[nodiscard]] std::uint64_t faults() const noexcept { return faults_; }

 private:
  std::uint64_t faults_ = 0;
};

}  // namespace carpus::haptics
