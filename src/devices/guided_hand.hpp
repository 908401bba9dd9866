// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hand of whoever calibrates a virtual drive A: it holds each leg in the gauge's notches, one
// after another, then lifts the platform with a finger while the servos turn, then presses it.
#pragma once

#include <cstddef>
#include <string>

#include "devices/arm_calibrator.hpp"
#include "virtual_arm/virtual_arm.hpp"

namespace carpus::devices {

class GuidedHand {
 public:
  static constexpr std::size_t kLift = kLegs * kGaugeDeg.size();
  static constexpr std::size_t kPress = kLift + 1;
  static constexpr std::size_t kSteps = kPress + 1;
  /// The step of the hand that a step of the calibrator wants.
  [[nodiscard]] static constexpr std::size_t step_for(std::size_t of_calibrator) noexcept {
    if (of_calibrator < kLift) return of_calibrator;
    return of_calibrator < kLift + kSweepUs.size() ? kLift : kPress;
  }
  /// "holds leg 1 in the gauge's notch at -40 degrees"; past the last step it moves by itself.
  [[nodiscard]] static std::string in_words(std::size_t step);

  /// To be called at least once a millisecond of the arm's clock. @param step  below kSteps.
  /// Another one is come to within a third of a second.
  void act(std::size_t step, virtual_arm::VirtualArm& arm);

 private:
  std::size_t step_ = kSteps;
  Vec3 from_;
  double begun_us_ = 0;
};

}  // namespace carpus::devices
