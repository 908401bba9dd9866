// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A gamepad by the kernel's own events (linux/input.h, its gamepad layout): sticks and triggers say
// how fast, buttons are bits, and where it can it rumbles for vibration. Nothing but the kernel's
// headers is needed, and events can be recorded and played by a test.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "devices/byte_link.hpp"
#include "devices/device.hpp"

namespace carpus::devices {

/// What is asked of the kernel besides reading: the range of an axis, a rumble. A test answers for
/// itself.
class GamepadControls {
 public:
  struct Range {
    std::int32_t least = -32768;
    std::int32_t most = 32767;
  };
  GamepadControls() = default;
  virtual ~GamepadControls() = default;
  GamepadControls(const GamepadControls&) = delete;
  GamepadControls& operator=(const GamepadControls&) = delete;
  /// @param axis  ABS_X and so on. @return none where there is no such axis.
  [[nodiscard]] virtual bool range(std::uint16_t axis, Range& out) const noexcept = 0;
  [[nodiscard]] virtual bool can_rumble() const noexcept = 0;
  /// @param share  0 to 1; called when it has changed, never waits.
  virtual void rumble(double share) noexcept = 0;
};

struct OpenGamepad {
  std::unique_ptr<ByteLink> link;
  std::unique_ptr<GamepadControls> controls;
};
using OpenGamepadFn = std::function<OpenGamepad()>;

/// Of /dev/input/event*. @throws IoError
[[nodiscard]] OpenGamepad open_gamepad(const std::string& path);
/// Whether the kernel says that it is a gamepad; false where it may not be read.
[[nodiscard]] bool is_gamepad(const std::string& path, std::string& name);

/// Bits of DeviceState::buttons, by place on the pad: south, east, north, west, left and right
/// shoulder, select, start.
inline constexpr int kPadButtons = 8;

class GamepadDevice final : public Device {
 public:
  explicit GamepadDevice(OpenGamepadFn open) : open_(std::move(open)) {}

  [[nodiscard]] Capabilities capabilities() const override;
  void open() override;
  void close() noexcept override;
  void poll(Nanoseconds now, DeviceState& state) noexcept override;
  void command(Nanoseconds now, const DeviceCommand& command) noexcept override;

 private:
  static constexpr std::size_t kAxes = 6;

  void take(std::uint16_t type, std::uint16_t code, std::int32_t value) noexcept;
  void report(Nanoseconds now) noexcept;

  OpenGamepadFn open_;
  OpenGamepad pad_;
  std::array<GamepadControls::Range, kAxes> ranges_;
  std::array<double, kAxes> axes_{};  ///< sticks -1 to 1, triggers 0 to 1
  DeviceState state_;
  double rumble_ = 0;
  Nanoseconds rumbled_ns_ = 0;
  bool is_dropping_ = false;
  std::array<std::uint8_t, 24> event_{};
  std::size_t event_count_ = 0;
};

}  // namespace carpus::devices
