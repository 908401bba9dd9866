// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Least squares of a = (p sin + q cos)(n angle) + r over the samples that move at a useful rate.
#include "arm/cogging_fit.hpp"

#include <cmath>
#include <string>

#include "core/units.hpp"

namespace carpus::arm {
namespace {

constexpr double kStepS = 0.001;
/// Slower, the hand takes part; faster, samples are too far apart [rad/s].
constexpr double kLeastRate = 0.3;
constexpr double kMostRate = 0.8;
/// More is a sample that was lost [rad/s2].
constexpr double kMostAcceleration = 1000;
constexpr int kLeastSamples = 500;
/// At the leg: five times what such motors have [N mm].
constexpr double kMostCogging = 75;

/// Solves the three normal equations by elimination; sums of squares are never zero here.
std::array<double, 3> solve(std::array<std::array<double, 4>, 3> m) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == i) continue;
      const double factor = m[k][i] / m[i][i];
      for (std::size_t j = i; j < 4; ++j) m[k][j] -= factor * m[i][j];
    }
  }
  return {m[0][3] / m[0][0], m[1][3] / m[1][1], m[2][3] / m[2][2]};
}

}  // namespace

Result<Cogging> fit_cogging(std::span<const LegAngles> angles) {
  Cogging cogging;
  for (std::size_t leg = 0; leg < 3; ++leg) {
    std::array<std::array<double, 4>, 3> sums{};
    int count = 0;
    for (std::size_t k = 1; k + 1 < angles.size(); ++k) {
      const double before = angles[k - 1][leg];
      const double here = angles[k][leg];
      const double after = angles[k + 1][leg];
      const double rate = std::abs(after - before) / (2 * kStepS);
      const double acceleration = (after - 2 * here + before) / (kStepS * kStepS);
      if (!(rate > kLeastRate && rate < kMostRate)) continue;
      if (!(std::abs(acceleration) < kMostAcceleration)) continue;
      const double turn = cogging.periods_per_turn * here;
      const std::array<double, 4> row{std::sin(turn), std::cos(turn), 1, acceleration};
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 4; ++j) sums[i][j] += row[i] * row[j];
      }
      ++count;
    }
    if (count < kLeastSamples) {
      return Refusal{"leg " + std::to_string(leg + 1) + " was moved too little"};
    }
    const std::array<double, 3> found = solve(sums);
    cogging.amplitude_n_mm[leg] = std::hypot(found[0], found[1]) * kMotorLegInertiaKgMm2 /
                                  kKilogramMillimeterPerSecond2PerNewton;
    cogging.phase_rad[leg] = std::atan2(found[1], found[0]);
    if (!(cogging.amplitude_n_mm[leg] < kMostCogging)) {
      return Refusal{"leg " + std::to_string(leg + 1) + " did not move evenly"};
    }
  }
  return cogging;
}

}  // namespace carpus::arm
