// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted hand moves: minimum-jerk moves between poses, and tremor on top.
#pragma once

#include "core/rng.hpp"
#include "core/units.hpp"
#include "geometry/vec3.hpp"

namespace carpus::trainee {

/// Tip and direction of what the hand holds.
struct HandPose {
  Vec3 tip;
  Vec3 shaft{0, 0, 1};
};

/// A move from rest to rest with the least jerk: 10 s^3 - 15 s^4 + 6 s^5 [flash1985coordination].
class MinimumJerkMove {
 public:
  MinimumJerkMove() = default;
  /// @param ticks  duration, at least 1.
  MinimumJerkMove(const HandPose& from, const HandPose& to, Tick ticks)
      : from_(from), to_(to), ticks_(ticks > 0 ? ticks : 1) {}

  /// The pose `elapsed` ticks after the start; the end pose from then on.
  [[nodiscard]] HandPose at(Tick elapsed) const noexcept {
    const double s =
        elapsed >= ticks_ ? 1.0 : static_cast<double>(elapsed) / static_cast<double>(ticks_);
    const double share = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
    return {from_.tip + (to_.tip - from_.tip) * share,
            normalized_or(from_.shaft + (to_.shaft - from_.shaft) * share, to_.shaft)};
  }
  [[nodiscard]] bool is_over(Tick elapsed) const noexcept { return elapsed >= ticks_; }

 private:
  HandPose from_;
  HandPose to_;
  Tick ticks_ = 1;
};

/// Physiological tremor as noise through a damped oscillator of about 9 Hz.
class Tremor {
 public:
  Tremor(double rms_mm, Rng rng) : rms_mm_(rms_mm), rng_(rng) {}

  /// Offset of the tip in the next tick [mm].
  [[nodiscard]] Vec3 next() noexcept {
    constexpr double kStiffness = 3200.0;  // (2 pi 9 Hz)^2
    constexpr double kDamping = 17.0;      // a sixth of critical
    // Variance of the driven oscillator: intensity / (2 damping stiffness).
    constexpr double kUnitRms = 330.0;  // sqrt(2 * 17 * 3200): acceleration noise for 1 mm rms
    constexpr double kRootTick = 0.0316227766;  // sqrt of a tick: noise per step
    for (std::size_t i = 0; i < 3; ++i) {
      const double push = rms_mm_ * kUnitRms * rng_.normal() * kRootTick;
      velocity_[i] += (-kStiffness * offset_[i] - kDamping * velocity_[i]) * kTickSeconds + push;
      offset_[i] += velocity_[i] * kTickSeconds;
    }
    return offset_;
  }

 private:
  double rms_mm_;
  Rng rng_;
  Vec3 offset_;
  Vec3 velocity_;
};

}  // namespace carpus::trainee
