// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/arm_calibrator.hpp"

#include <algorithm>
#include <cmath>

#include "arm/cogging_fit.hpp"
#include "core/units.hpp"

namespace carpus::devices {
namespace {

constexpr std::size_t kNotches = kGaugeDeg.size();
constexpr std::size_t kHeld = kLegs * kNotches;
/// Drive B's steps behind its cradle.
constexpr std::size_t kAlign = 1;
constexpr std::size_t kLead = 2;
constexpr int kAnyPulse = 1500;
constexpr std::size_t kSweep = kSweepUs.size();
constexpr std::size_t kSwept = kSweep + kSweepBackUs.size();
/// A servo comes from one row's end to the other's, or one pulse further.
constexpr int kFarMs = 1800;
constexpr int kNearMs = 500;
/// Slots are cut for 9 degrees; gears' play is found with them.
constexpr double kLeastGapDeg = 5;
constexpr double kMostGapDeg = 13;
/// A tooth of the horn's spline may cost so much of the servo's travel.
constexpr double kMissingDeg = 5;
constexpr double kLeastPulseUs = 900;
constexpr double kMostPulseUs = 2100;
/// The middle of a leg's way, and how far the slot goes from there.
constexpr double kMiddleRad = 0.1775;

/// Pulse and angle of one sweep, without its first: the mean of both, and sums for the slope.
struct Line {
  double pulse = 0;
  double angle = 0;
  double squares = 0;
  double products = 0;
};

Line line_of(const std::array<int, kSweep>& pulses, const std::array<double, kSweep>& angles) {
  constexpr double kCount = kSweep - 1;
  Line line;
  for (std::size_t i = 1; i < kSweep; ++i) {
    line.pulse += pulses[i] / kCount;
    line.angle += angles[i] / kCount;
  }
  for (std::size_t i = 1; i < kSweep; ++i) {
    line.squares += (pulses[i] - line.pulse) * (pulses[i] - line.pulse);
    line.products += (pulses[i] - line.pulse) * (angles[i] - line.angle);
  }
  return line;
}

}  // namespace

std::string notch_in_words(std::size_t step) {
  const std::size_t notch = step % kNotches;
  const int below = static_cast<int>(kGaugeDeg[notch]);
  const std::string dots = std::to_string(notch + 1) + (notch == 0 ? " dot" : " dots");
  const std::string angle = below == 0 ? "level"
                                       : std::to_string(below < 0 ? -below : below) + " degrees " +
                                             (below < 0 ? "up" : "down");
  return "notch of " + dots + ", " + angle;
}

ArmCalibrator::ArmCalibrator(firmware::Drive drive,
                             std::uint32_t unit,
                             std::optional<ArmCalibration> known) {
  if (known) made_ = *known;
  made_.drive = drive;
  made_.unit = unit;
}

std::size_t ArmCalibrator::step_count() const noexcept {
  return made_.drive == firmware::Drive::Stop ? kHeld + kSwept : kLead + 1;
}

bool ArmCalibrator::is_whole() const noexcept {
  return is_complete() || (made_.drive == firmware::Drive::Motor && step_ == kLead);
}

bool ArmCalibrator::is_by_itself() const noexcept {
  // Before the first of each row a person takes hold.
  return made_.drive == firmware::Drive::Stop && step_ > kHeld && step_ != kHeld + kSweep &&
         !is_complete();
}

int ArmCalibrator::pulse_us() const noexcept {
  if (made_.drive == firmware::Drive::Motor) return step_ == kAlign ? kAnyPulse : 0;
  if (made_.drive != firmware::Drive::Stop || step_ < kHeld || is_complete()) return 0;
  const std::size_t at = step_ - kHeld;
  return at < kSweep ? kSweepUs[at] : kSweepBackUs[at - kSweep];
}

int ArmCalibrator::settle_ms() const noexcept {
  if (pulse_us() == 0 || made_.drive == firmware::Drive::Motor) return 0;
  return (step_ - kHeld) % kSweep == 0 ? kFarMs : kNearMs;
}

std::size_t ArmCalibrator::sample_count() const noexcept {
  if (made_.drive == firmware::Drive::Stop) return kSamplesOfStep;
  return step_ == kLead ? kSamplesOfLead : step_ == kAlign ? kSamplesOfAlignment : kSamplesOfStep;
}

bool ArmCalibrator::is_enough(std::size_t samples, const MotorWindings& windings) const noexcept {
  const bool is_aligned = made_.drive == firmware::Drive::Motor && step_ == kAlign &&
                          windings.progress >= static_cast<std::uint8_t>(firmware::Progress::Found);
  return is_aligned || samples >= sample_count();
}

std::string ArmCalibrator::instruction() const {
  if (is_complete()) return "All is measured.";
  if (made_.drive == firmware::Drive::Motor && step_ == kAlign) {
    return "Take the cradle out, give the motors their supply and carry the tool in two fingers in "
           "the "
           "middle of its way: its motors turn now by themselves, one after another, a centimetre "
           "to and fro. Go along, for eight seconds.";
  }
  if (made_.drive == firmware::Drive::Motor && step_ == kLead) {
    return "Take the tool and lead its tip about in level circles, as wide as a coin, one a "
           "second, "
           "for eight seconds.";
  }
  if (step_ >= kHeld) {
    const bool is_first = step_ < kHeld + kSweep;
    return std::string(is_first ? "Put the rods on, give the servos their supply. Lift"
                                : "And once more: press") +
           " the platform gently " + (is_first ? "up" : "down") +
           " with a finger, and follow it: its servos turn now, to and fro.";
  }
  if (made_.drive == firmware::Drive::Motor) {
    return "Clip the cradle round the tool, between its handle and the portal's frame, and let go.";
  }
  return "Leg " + std::to_string(step_ / kNotches + 1) + ": hold it in the gauge's " +
         notch_in_words(step_) + ", and keep it still.";
}

std::optional<std::string> ArmCalibrator::take(
    const std::vector<std::array<std::int32_t, kLegs>>& samples,
    const MotorWindings& windings) {
  if (is_complete()) return "Nothing is left to measure.";
  const bool is_motor = made_.drive == firmware::Drive::Motor;
  if (is_motor && step_ == kAlign) return take_windings(windings);
  if (samples.size() < sample_count() / 2) {
    return "The arm said too little: look whether it is on, and do this step again.";
  }
  if (is_motor && step_ == kLead) return take_lead(samples);
  const bool is_swept = pulse_us() != 0;
  const bool is_on_the_way = is_swept && (step_ - kHeld) % kSweep == 0;
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
    const bool counts = is_motor || (is_swept ? !is_on_the_way : leg == step_ / kNotches);
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
  } else if (is_swept) {
    for (std::size_t leg = 0; leg < kLegs; ++leg) swept_[leg][step_ - kHeld] = means[leg];
  } else {
    const std::size_t leg = step_ / kNotches;
    points_[leg].push_back({radians_from_degrees(kGaugeDeg[step_ % kNotches]), means[leg]});
    if (points_[leg].size() == kNotches) {
      if (const auto problem = fit_leg(leg)) return problem;
    }
  }
  ++step_;
  return std::nullopt;
}

/// At once after its last notch, while the gauge still sits on its block.
std::optional<std::string> ArmCalibrator::fit_leg(std::size_t leg) {
  const Result<arm::LegCalibration> one = arm::calibrate_leg(points_[leg]);
  if (!one) {
    points_[leg].clear();
    step_ = leg * kNotches;
    return "Leg " + std::to_string(leg + 1) + ": " + one.error() +
           ". The steps of this leg begin anew.";
  }
  made_.legs[leg] = *one;
  return std::nullopt;
}

std::optional<std::string> ArmCalibrator::take_windings(const MotorWindings& windings) {
  const auto progress = static_cast<firmware::Progress>(windings.progress);
  if (progress == firmware::Progress::Refused) {
    return "A motor did not follow: look at the mushroom switch, its supply and its plug, let the "
           "tool go along, and do this step again.";
  }
  if (progress != firmware::Progress::Found) {
    return "Its motors are not done: look whether they have their supply, and do this step again.";
  }
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    made_.windings[leg].electrical_zero = windings.electrical_zero[leg];
    made_.windings[leg].windings = static_cast<firmware::Windings>(windings.windings[leg]);
  }
  ++step_;
  return std::nullopt;
}

/// Ten periods of cogging are four degrees of a leg.
std::optional<std::string> ArmCalibrator::take_lead(
    const std::vector<std::array<std::int32_t, kLegs>>& samples) {
  std::vector<arm::LegAngles> angles(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      angles[i][leg] = (samples[i][leg] - made_.zero_in_turn[leg]) * kRadPerMotorCount;
    }
  }
  const Result<arm::Cogging> found = arm::fit_cogging(angles);
  if (!found) return found.error() + ": lead it wider or quicker, and do this step again.";
  made_.cogging = *found;
  ++step_;
  return std::nullopt;
}

/// Both sweeps see the same servo, a slot apart.
std::optional<std::string> ArmCalibrator::fit_servo(std::size_t leg) {
  std::array<double, kSweep> up{};
  std::array<double, kSweep> back{};
  for (std::size_t i = 0; i < kSweep; ++i) {
    up[i] = made_.legs[leg].angle_at(swept_[leg][i]);
    back[i] = made_.legs[leg].angle_at(swept_[leg][kSweep + i]);
  }
  const Line there = line_of(kSweepUs, up);
  const Line again = line_of(kSweepBackUs, back);
  const double rad_per_us = (there.products + again.products) / (there.squares + again.squares);
  if (!(std::abs(rad_per_us) > radians_from_degrees(0.05))) {
    return "its servo does not turn it: look at its plug, its supply and its horn.";
  }
  ServoFit fit;
  fit.gap_rad = 0.5 * std::abs(again.angle - there.angle);
  const double gap_deg = degrees_from_radians(fit.gap_rad);
  if (!(gap_deg > kLeastGapDeg && gap_deg < kMostGapDeg)) {
    return "its slot measured " + std::to_string(static_cast<int>(std::lround(gap_deg))) +
           " degrees to a side and not 9: see that it moves freely and is balanced.";
  }
  fit.pulse_per_half_turn_us = kPi / rad_per_us;
  fit.pulse_at_zero_us =
      0.5 * (there.pulse + again.pulse) - 0.5 * (there.angle + again.angle) / rad_per_us;
  const double half = radians_from_degrees(0.5 * kServoTravelDeg) / std::abs(rad_per_us);
  const double middle = fit.pulse_at_zero_us + kMiddleRad / rad_per_us;
  const double missing_us =
      std::max({0.0, kLeastPulseUs - (middle - half), middle + half - kMostPulseUs});
  if (degrees_from_radians(missing_us * std::abs(rad_per_us)) > kMissingDeg) {
    const double travel =
        degrees_from_radians((kMostPulseUs - kLeastPulseUs) * std::abs(rad_per_us));
    return "its servo turns " + std::to_string(static_cast<int>(travel)) +
           " degrees in 0.9 to 2.1 ms, and 10 degrees below the horizontal is at " +
           std::to_string(static_cast<int>(middle)) +
           " us; the leg needs 154 about there: put in a servo of 270 degrees, its horn as the "
           "guide says.";
  }
  fit.least_pulse_us = std::max(kLeastPulseUs, middle - half);
  fit.most_pulse_us = std::min(kMostPulseUs, middle + half);
  made_.servos[leg] = fit;
  return std::nullopt;
}

Result<ArmCalibration> ArmCalibrator::finish(std::string made_at) {
  if (!is_whole()) return Refusal{"Not all steps are done."};
  if (made_.drive == firmware::Drive::Stop) {
    for (std::size_t leg = 0; leg < kLegs; ++leg) {
      if (const auto problem = fit_servo(leg)) {
        step_ = kHeld;
        return Refusal{"Leg " + std::to_string(leg + 1) + ": " + *problem};
      }
    }
  }
  made_.made_at = std::move(made_at);
  return made_;
}

}  // namespace carpus::devices
