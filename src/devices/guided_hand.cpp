// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/guided_hand.hpp"

#include <algorithm>

#include "arm/delta_arm.hpp"
#include "core/units.hpp"

namespace carpus::devices {
namespace {

/// The gauge: stiffer than any hand.
constexpr virtual_arm::HandModel kGauge{"gauge", 0.05, 0.02, 20};
constexpr double kOnTheWayUs = 300e3;
/// A finger that follows with 0.7 N: what a light hand gives that is so far beside.
constexpr double kFingerMm = 12;

}  // namespace

std::string GuidedHand::in_words(std::size_t step) {
  if (step == kLift) return "lifts the platform with a finger";
  if (step == kPress) return "presses the platform with a finger";
  if (step >= kSteps) return "moves by itself";
  const auto degrees = static_cast<int>(kGaugeDeg[step % kGaugeDeg.size()]);
  return "holds leg " + std::to_string(step / kGaugeDeg.size() + 1) + " in the gauge's notch at " +
         std::to_string(degrees) + " degrees";
}

void GuidedHand::act(std::size_t step, virtual_arm::VirtualArm& arm) {
  virtual_arm::ArmPlant& plant = arm.plant();
  if (step != step_) {
    step_ = step;
    from_ = plant.tip();
    begun_us_ = arm.now_us();
    plant.set_hand(step < kLift ? kGauge : virtual_arm::kHandModels[0]);
  }
  const double share = std::min(1.0, (arm.now_us() - begun_us_) / kOnTheWayUs);
  if (step >= kLift) {
    const double way = step == kLift ? kFingerMm : -kFingerMm;
    plant.set_intent({plant.tip() + Vec3{0, 0, way * share}, {}});
    return;
  }
  const double middle = cradle_angle_rad();
  arm::LegAngles held{middle, middle, middle};
  held[step / kGaugeDeg.size()] = radians_from_degrees(kGaugeDeg[step % kGaugeDeg.size()]);
  if (const auto tip = arm::forward(arm.size(), held)) {
    plant.set_intent({from_ + (*tip - from_) * share, {}});
  }
}

}  // namespace carpus::devices
