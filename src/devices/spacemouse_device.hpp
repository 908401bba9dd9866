// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A SpaceMouse through spacenavd, the open daemon for it: a socket of this machine on which each
// event is eight 32-bit integers, type first (0 motion: x y z, rx ry rz, ms since the last; 1 and 2
// a button, pressed and let go). It says how fast it is to be moved, not where it is.
#pragma once

#include <utility>

#include "devices/byte_link.hpp"
#include "devices/device.hpp"

namespace carpus::devices {

inline constexpr const char* kSpacenavSocket = "/var/run/spnav.sock";

class SpaceMouseDevice final : public Device {
 public:
  explicit SpaceMouseDevice(OpenLink open_link) : open_link_(std::move(open_link)) {}

  [[nodiscard]] Capabilities capabilities() const override;
  void open() override;
  void close() noexcept override { link_.reset(); }
  void poll(Nanoseconds now, DeviceState& state) noexcept override;
  void command(Nanoseconds, const DeviceCommand&) noexcept override {}

 private:
  static constexpr std::size_t kEventBytes = 32;
  /// The daemon says nothing while nobody touches it; a cap that is held is told all the time.
  static constexpr Nanoseconds kAtRestNs = 200 * kNsPerMs;

  void take_event(Nanoseconds now) noexcept;

  OpenLink open_link_;
  std::unique_ptr<ByteLink> link_;
  DeviceState state_;
  std::array<std::uint8_t, kEventBytes> event_{};
  std::size_t event_count_ = 0;
};

}  // namespace carpus::devices
