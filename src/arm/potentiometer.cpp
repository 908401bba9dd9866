// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arm/potentiometer.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::arm {
namespace {

struct Span {
  double low;
  double high;
};

Span span_of(CardRange range) {
  switch (range) {
    case CardRange::PlusMinus10V:
      return {-10, 10};
    case CardRange::PlusMinus5V:
      return {-5, 5};
    case CardRange::To10V:
      return {0, 10};
    case CardRange::To5V:
      return {0, 5};
  }
  return {0, 5};
}

constexpr double kCardCounts = 4096;

}  // namespace

Potentiometer::Potentiometer(const PotentiometerKind& kind, std::uint64_t seed)
    : kind_(kind), travel_rad_(kind.travel_rad), rng_(seed) {
  travel_rad_ += rng_.uniform(-1, 1) * kind.travel_spread_rad;
  double sum = 0;
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    waves_[i] = rng_.uniform(0.2, 1);
    phases_[i] = rng_.uniform(0, 2 * kPi);
    sum += waves_[i];
  }
  const double most = kind.linearity * rng_.uniform(0.25, 1);
  for (double& wave : waves_) wave *= most / sum;
}

double Potentiometer::share_at(double angle) const noexcept {
  double along = angle / travel_rad_ + 0.5;
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    along += waves_[i] * std::sin(2 * kPi * static_cast<double>(i + 1) * along + phases_[i]);
  }
  return kind_.end_share + (1 - 2 * kind_.end_share) * std::clamp(along, 0.0, 1.0);
}

double Potentiometer::read(double angle) noexcept {
  if (!has_wiper_) wiper_ = angle;
  has_wiper_ = true;
  wiper_ = std::clamp(wiper_, angle - kind_.hysteresis_rad / 2, angle + kind_.hysteresis_rad / 2);
  return std::clamp(share_at(wiper_) + kind_.noise_share * rng_.normal(), 0.0, 1.0);
}

std::uint16_t counts_of(double share, int bits) noexcept {
  const double most = static_cast<double>((1 << bits) - 1);
  // A converter rounds down: a count begins at its voltage.
  return static_cast<std::uint16_t>(std::clamp(std::floor(share * (most + 1)), 0.0, most));
}

std::uint16_t card_counts(double volts, CardRange range) noexcept {
  const Span span = span_of(range);
  return counts_of((volts - span.low) / (span.high - span.low), 12);
}

double card_volts(std::uint16_t counts, CardRange range) noexcept {
  const Span span = span_of(range);
  return span.low + (counts + 0.5) / kCardCounts * (span.high - span.low);
}

double servo_pulse_ms(double angle_deg) noexcept {
  return 1.0 + std::clamp(angle_deg, 0.0, 180.0) / 180.0;
}
double servo_angle_deg(double pulse_ms) noexcept {
  return 180.0 * (std::clamp(pulse_ms, 1.0, 2.0) - 1.0);
}

}  // namespace carpus::arm
