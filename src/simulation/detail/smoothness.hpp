// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How smoothly a tip is led, by its dimensionless jerk [balasubramanian2012robust]
// [balasubramanian2015analysis]: over a movement, duration cubed / peak speed squared * integral of
// the squared jerk. A minimum-jerk reach [flash1985coordination] has 720 / 1.875^2 = 204.8,
// whatever its length and duration.
//
// A movement is a stretch of 5 mm of way, not what lies between two rests: small hops with rests
// between are each smooth. Rest counts for nothing, slow or fast for nothing; of the stretches'
// figures the geometric mean is kept, so that one slip does not decide. Spectral arc length bears
// noise better, but wants the whole speed profile and a Fourier transform: the tick has neither.
// Noise is met by means over 25 ms instead, which pass a tremor of 10 Hz.
#pragma once

#include <array>
#include <cstdint>

#include "geometry/vec3.hpp"
#include "procedure/operation_record.hpp"
#include "simulation/detail/operation_state.hpp"

namespace carpus::simulation::detail {

inline constexpr std::uint32_t kMeanTicks = 25;
inline constexpr std::size_t kMeans = 10;  ///< over which it is asked whether the tip goes anywhere
inline constexpr double kMeanSeconds = kMeanTicks * kTickSeconds;
/// Slower, over those means, it rests: tremor in place gets nowhere [E].
inline constexpr double kRestMmPerS = 1.0;
/// A rest no longer than this is hesitation, and part of the movement [E].
inline constexpr double kHesitationS = 0.5;

/// Of the instrument in one hand, while it is in a joint.
struct MotionMeter {
  Vec3 sum;  ///< of the ticks since the last mean
  std::uint32_t ticks = 0;
  std::array<Vec3, kMeans> means{};  ///< the first `mean_count`, the oldest first
  std::uint8_t mean_count = 0;
  // The stretch under way.
  double way_mm = 0.0;
  double moving_s = 0.0;
  double squared_jerk = 0.0;  ///< its integral [mm2/s5]
  double peak_mm_per_s = 0.0;
  // Rest since it last moved; of more than hesitation it is forgotten how long.
  double rest_s = 2 * kHesitationS;
  double rest_squared_jerk = 0.0;
  bool operator==(const MotionMeter&) const = default;
};

template <Is<MotionMeter> SomeMeter, typename Visitor>
void visit(SomeMeter& meter, Visitor&& v) noexcept {
  v(meter.sum);
  v(meter.ticks);
  for (auto& mean : meter.means) v(mean);
  v(meter.mean_count);
  v(meter.way_mm);
  v(meter.moving_s);
  v(meter.squared_jerk);
  v(meter.peak_mm_per_s);
  v(meter.rest_s);
  v(meter.rest_squared_jerk);
}

template <Is<procedure::SmoothnessFacts> SomeFacts, typename Visitor>
void visit(SomeFacts& facts, Visitor&& v) noexcept {
  v(facts.product);
  v(facts.octaves);
  v(facts.stretches);
}

[[nodiscard]] bool is_possible(const MotionMeter& meter,
                               const procedure::SmoothnessFacts& facts) noexcept;

/// The tip of one tick; a stretch that it ends is added to `facts`.
void add_tip(MotionMeter& meter, const Vec3& tip, procedure::SmoothnessFacts& facts) noexcept;

}  // namespace carpus::simulation::detail
