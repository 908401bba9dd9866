// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hand of whoever calibrates a virtual arm. Drive A: it holds each leg in the gauge's notches,
// one after another, then lifts the platform with a finger while the servos turn, then presses it.
// Drive B: it lays the arm in its cradle, goes along in two fingers while the motors look for their
// windings, leads it about in circles.
#pragma once

#include <cstddef>
#include <string>

#include "devices/arm_calibrator.hpp"
#include "virtual_arm/virtual_arm.hpp"

namespace carpus::devices {

class GuidedHand {
 public:
  explicit GuidedHand(firmware::Drive drive) noexcept : drive_(drive) {}

  [[nodiscard]] std::size_t step_count() const noexcept;
  /// The step of the hand that a step of the calibrator wants.
  [[nodiscard]] std::size_t step_for(std::size_t of_calibrator) const noexcept;
  /// "holds leg 1 in the gauge's notch at -40 degrees"; past the last step it moves by itself.
  [[nodiscard]] std::string in_words(std::size_t step) const;

  /// To be called at least once a millisecond of the arm's clock. @param step  below step_count().
  /// Another one is come to within a third of a second.
  void act(std::size_t step, virtual_arm::VirtualArm& arm);

 private:
  void act_on_stops(std::size_t step, double share, virtual_arm::VirtualArm& arm) const;
  void act_on_motors(std::size_t step, double share, virtual_arm::VirtualArm& arm) const;

  firmware::Drive drive_;
  std::size_t step_ = static_cast<std::size_t>(-1);
  Vec3 from_;
  double begun_us_ = 0;
};

}  // namespace carpus::devices
