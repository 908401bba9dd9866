// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One specimen of the virtual arm, with the calibration that a guided one would find: for tests,
// and for `carpus device simulate`.
#pragma once

#include <cstdint>
#include <memory>

#include "devices/arm_calibration.hpp"
#include "virtual_arm/virtual_arm.hpp"

namespace carpus::devices {

class VirtualUnit {
 public:
  /// @param unit  its number, by which its specimens of all parts are chosen.
  VirtualUnit(firmware::Drive drive, std::uint32_t unit);

  [[nodiscard]] virtual_arm::VirtualArm& arm() noexcept { return *arm_; }
  [[nodiscard]] ArmCalibration calibration() const;

 private:
  std::uint32_t unit_;
  std::unique_ptr<virtual_arm::VirtualArm> arm_;
};

}  // namespace carpus::devices
