// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/smoothness.hpp"

#include <algorithm>

namespace carpus::simulation::detail {
namespace {

/// In the time of a mean no hand gets so far (350 mm/s): the tip was put elsewhere, as by undo.
constexpr double kJumpMm = 10.0;
constexpr double kMost = 1e12;  // of a stretch: no more than 40 octaves

/// The product is kept within one octave: it never overflows, and no logarithm is taken in a tick.
void add_stretch(const MotionMeter& meter, procedure::SmoothnessFacts& facts) noexcept {
  const double peak = meter.peak_mm_per_s;
  const double cubed_s = meter.moving_s * meter.moving_s * meter.moving_s;
  const double jerk = cubed_s * meter.squared_jerk / (peak * peak);
  // Nothing is smoother than a minimum-jerk reach: a long even glide buys no jerky one.
  facts.product *=
      jerk > procedure::kLeastJerk ? std::min(jerk, kMost) : double{procedure::kLeastJerk};
  for (; facts.product >= 2.0; ++facts.octaves) facts.product *= 0.5;
  ++facts.stretches;
}

void note_mean(MotionMeter& meter, procedure::SmoothnessFacts& facts) noexcept {
  const auto& p = meter.means;
  // All three are of the same moment, the middle of the means.
  constexpr std::size_t kBefore = kMeans / 2 - 1;
  static_assert(kMeans % 2 == 0 && kBefore >= 1);
  const Vec3 step = p[kBefore + 1] - p[kBefore];
  const Vec3 third = p[kBefore + 2] - step * 3.0 - p[kBefore - 1];
  constexpr double kCubed = kMeanSeconds * kMeanSeconds * kMeanSeconds;
  const double squared_jerk = squared_length(third) / (kCubed * kCubed) * kMeanSeconds;
  const double gets_on = distance(p.back(), p.front()) / ((kMeans - 1) * kMeanSeconds);
  const bool hesitates = meter.rest_s <= kHesitationS;
  if (gets_on < kRestMmPerS) {
    if (!hesitates) return;
    meter.rest_s += kMeanSeconds;
    meter.rest_squared_jerk += squared_jerk;
    return;
  }
  if (hesitates) {
    meter.moving_s += meter.rest_s;
    meter.squared_jerk += meter.rest_squared_jerk;
  }
  meter.rest_s = meter.rest_squared_jerk = 0.0;
  meter.moving_s += kMeanSeconds;
  meter.squared_jerk += squared_jerk;
  meter.peak_mm_per_s = std::max(meter.peak_mm_per_s, length(step) / kMeanSeconds);
  meter.way_mm += gets_on * kMeanSeconds;
  if (meter.way_mm < procedure::kStretchMm) return;
  if (meter.peak_mm_per_s > 0.0) add_stretch(meter, facts);
  meter.way_mm = meter.moving_s = meter.squared_jerk = meter.peak_mm_per_s = 0.0;
}

}  // namespace

void add_tip(MotionMeter& meter, const Vec3& tip, procedure::SmoothnessFacts& facts) noexcept {
  if (meter.ticks > 0 && distance(tip, meter.sum * (1.0 / meter.ticks)) > kJumpMm) meter = {};
  meter.sum += tip;
  if (++meter.ticks < kMeanTicks) return;
  const Vec3 mean = meter.sum * (1.0 / kMeanTicks);
  meter.sum = {};
  meter.ticks = 0;
  if (meter.mean_count > 0 && distance(mean, meter.means[meter.mean_count - 1U]) > kJumpMm) {
    meter = {};
  }
  if (meter.mean_count == kMeans) {
    std::copy(meter.means.begin() + 1, meter.means.end(), meter.means.begin());
    --meter.mean_count;
  }
  meter.means[meter.mean_count++] = mean;
  if (meter.mean_count == kMeans) note_mean(meter, facts);
}

bool is_possible(const MotionMeter& meter, const procedure::SmoothnessFacts& facts) noexcept {
  return meter.ticks < kMeanTicks && meter.mean_count <= kMeans && meter.way_mm >= 0.0 &&
         meter.way_mm < procedure::kStretchMm && meter.moving_s >= 0.0 &&
         meter.squared_jerk >= 0.0 && meter.peak_mm_per_s >= 0.0 && meter.rest_s >= 0.0 &&
         meter.rest_squared_jerk >= 0.0 && facts.product >= 1.0 && facts.product < 2.0;
}

}  // namespace carpus::simulation::detail
