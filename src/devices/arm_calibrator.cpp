// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/arm_calibrator.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace carpus::devices {
namespace {

constexpr std::size_t kNotches = kGaugeDeg.size();

std::string degrees_of(std::size_t step) {
  return std::to_string(static_cast<int>(kGaugeDeg[step % kNotches]));
}

}  // namespace

ArmCalibrator::ArmCalibrator(firmware::Drive drive,
                             std::uint32_t unit,
                             std::optional<ArmCalibration> known) {
  if (known) made_ = *known;
  made_.drive = drive;
  made_.unit = unit;
}

std::size_t ArmCalibrator::step_count() const noexcept {
  return made_.drive == firmware::Drive::Stop ? kLegs * kNotches : 1;
}

std::string ArmCalibrator::instruction() const {
  if (is_complete()) return "All is measured.";
  if (made_.drive == firmware::Drive::Motor) {
    return "Lay the arm in its cradle, so that all three legs rest on it, and let go.";
  }
  return "Leg " + std::to_string(step_ / kNotches + 1) + ": hold it in the gauge's notch at " +
         degrees_of(step_) + " degrees and keep it still.";
}

std::optional<std::string> ArmCalibrator::take(
    const std::vector<std::array<std::int32_t, kLegs>>& samples) {
  if (is_complete()) return "Nothing is left to measure.";
  if (samples.size() < kSamplesOfStep / 2) {
    return "The arm said too little: look whether it is on, and do this step again.";
  }
  const bool is_motor = made_.drive == firmware::Drive::Motor;
  std::array<double, kLegs> means{};
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    std::int32_t least = samples.front()[leg];
    std::int32_t most = least;
    double sum = 0;
    for (const auto& sample : samples) {
      least = std::min(least, sample[leg]);
      most = std::max(most, sample[leg]);
      sum += sample[leg];
    }
    means[leg] = sum / static_cast<double>(samples.size());
    const bool counts = is_motor || leg == step_ / kNotches;
    if (counts && most - least > (is_motor ? kMostSpreadMotor : kMostSpreadStop)) {
      return "Leg " + std::to_string(leg + 1) + " moved by " + std::to_string(most - least) +
             " counts: keep it still and do this step again.";
    }
  }
  if (is_motor) {
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      const auto zero = std::lround(means[leg] - cradle_angle_rad() / kRadPerMotorCount);
      const auto in_turn = static_cast<std::int32_t>(zero % kCountsOfTurn);
      made_.zero_in_turn[leg] = in_turn < 0 ? in_turn + kCountsOfTurn : in_turn;
    }
  } else {
    const std::size_t leg = step_ / kNotches;
    points_[leg].push_back({radians_from_degrees(kGaugeDeg[step_ % kNotches]), means[leg]});
  }
  ++step_;
  return std::nullopt;
}

Result<ArmCalibration> ArmCalibrator::finish(std::string made_at) {
  if (!is_complete()) return Refusal{"Not all steps are done."};
  if (made_.drive == firmware::Drive::Stop) {
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      const Result<arm::LegCalibration> one = arm::calibrate_leg(points_[leg]);
      if (!one) {
        step_ = 0;
        for (auto& points : points_) points.clear();
        return Refusal{"Leg " + std::to_string(leg + 1) + ": " + one.error() +
                       ". The steps begin anew."};
      }
      made_.legs[leg] = *one;
    }
  }
  made_.made_at = std::move(made_at);
  return made_;
}

}  // namespace carpus::devices
