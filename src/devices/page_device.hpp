// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The page as a device: what its pointer, fingers, gamepad or headset controller wish came as poses
// already (the protocol's `hand`), so it needs no driver; here it has health and figures as all
// others have.
#pragma once

#include "core/latest_value.hpp"
#include "devices/device.hpp"

namespace carpus::devices {

class PageDevice final : public Device {
 public:
  /// A page that moves says so each frame; one that rests says nothing, and is well.
  static constexpr Nanoseconds kSilentPageNs = 2000 * kNsPerMs;

  [[nodiscard]] Capabilities capabilities() const override {
    Capabilities able;
    able.position = able.rotation = able.absolute = true;
    able.rate_hz = 60;
    return able;
  }
  void open() override {}
  void close() noexcept override {}
  /// The page was heard: a hand, or that it is alive.
  void heard(const Vec3& tip_in_patient_mm, Nanoseconds now) noexcept {
    said_.position_mm = tip_in_patient_mm;
    said_.heard_ns = now;
    ++said_.samples;
    says_.publish(said_);
  }
  void poll(Nanoseconds now, DeviceState& state) noexcept override {
    (void)says_.take(state_);
    state_.health = now - state_.heard_ns > kSilentPageNs ? Health::Silent : Health::Good;
    state = state_;
  }
  void command(Nanoseconds, const DeviceCommand&) noexcept override {}

 private:
  DeviceState said_;
  DeviceState state_;
  LatestValue<DeviceState> says_;
};

}  // namespace carpus::devices
