// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/guided_hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "arm/delta_arm.hpp"
#include "core/units.hpp"

namespace carpus::devices {
namespace {

/// Gauge and cradle: stiffer than any hand.
constexpr virtual_arm::HandModel kHeld{"held", 0.05, 0.02, 20};
constexpr double kOnTheWayUs = 300e3;
/// A finger that follows with 0.7 N: what a light hand gives that is so far beside.
constexpr double kFingerMm = 12;
constexpr double kCircleMm = 9;

constexpr std::size_t kLift = kLegs * kGaugeDeg.size();
constexpr std::size_t kPress = kLift + 1;
constexpr std::array kOnMotors{"has laid the arm in its cradle", "goes along in two fingers",
                               "leads it about in circles, one a second"};

}  // namespace

std::size_t GuidedHand::step_count() const noexcept {
  return drive_ == firmware::Drive::Motor ? kOnMotors.size() : kPress + 1;
}

std::size_t GuidedHand::step_for(std::size_t of_calibrator) const noexcept {
  if (drive_ == firmware::Drive::Motor || of_calibrator < kLift) return of_calibrator;
  return of_calibrator < kLift + kSweepUs.size() ? kLift : kPress;
}

std::string GuidedHand::in_words(std::size_t step) const {
  if (step >= step_count()) return "moves by itself";
  if (drive_ == firmware::Drive::Motor) return kOnMotors[step];
  if (step == kLift) return "lifts the platform with a finger";
  if (step == kPress) return "presses the platform with a finger";
  return "holds leg " + std::to_string(step / kGaugeDeg.size() + 1) + " in the gauge's " +
         notch_in_words(step);
}

void GuidedHand::act(std::size_t step, virtual_arm::VirtualArm& arm) {
  if (step != step_) {
    step_ = step;
    from_ = arm.plant().tip();
    begun_us_ = arm.now_us();
  }
  const double share = std::min(1.0, (arm.now_us() - begun_us_) / kOnTheWayUs);
  if (drive_ == firmware::Drive::Motor) return act_on_motors(step, share, arm);
  act_on_stops(step, share, arm);
}

void GuidedHand::act_on_stops(std::size_t step, double share, virtual_arm::VirtualArm& arm) const {
  virtual_arm::ArmPlant& plant = arm.plant();
  if (step >= kLift) {
    plant.set_hand(virtual_arm::kHandModels[0]);
    const double way = step == kLift ? kFingerMm : -kFingerMm;
    plant.set_intent({plant.tip() + Vec3{0, 0, way * share}, {}});
    return;
  }
  const double middle = cradle_angle_rad();
  arm::LegAngles held{middle, middle, middle};
  held[step / kGaugeDeg.size()] = radians_from_degrees(kGaugeDeg[step % kGaugeDeg.size()]);
  plant.set_hand(kHeld);
  if (const auto tip = arm::forward(arm.size(), held)) {
    plant.set_intent({from_ + (*tip - from_) * share, {}});
  }
}

void GuidedHand::act_on_motors(std::size_t step, double share, virtual_arm::VirtualArm& arm) const {
  virtual_arm::ArmPlant& plant = arm.plant();
  const Vec3 centre = arm.size().centre;
  plant.set_hand(step == 0 ? kHeld : virtual_arm::kHandModels[step == 1 ? 0 : 1]);
  Vec3 place = from_ + (centre - from_) * share;
  if (step == 2) {
    const double turn = 2e-6 * kPi * (arm.now_us() - begun_us_);
    place += Vec3{std::sin(turn), std::cos(turn), 0} * (kCircleMm * share);
  }
  plant.set_intent({place, {}});
}

}  // namespace carpus::devices
