// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/gamepad_device.hpp"

#include <linux/input.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace carpus::devices {
namespace {

constexpr std::uint16_t kAxisCodes[] = {ABS_X, ABS_Y, ABS_RX, ABS_RY, ABS_Z, ABS_RZ};
constexpr std::uint16_t kButtonCodes[kPadButtons] = {BTN_SOUTH, BTN_EAST, BTN_NORTH,  BTN_WEST,
                                                     BTN_TL,    BTN_TR,   BTN_SELECT, BTN_START};
constexpr std::size_t kFirstTrigger = 4;
constexpr double kFastestMmPerS = 30;
constexpr double kFastestRadPerS = 1.2;
/// A worn stick rests as far off its middle as this.
constexpr double kDead = 0.15;
/// A rumble is changed no more often: each is a call into the kernel.
constexpr Nanoseconds kRumbleNs = 20 * kNsPerMs;

static_assert(sizeof(input_event) == 24, "a 64-bit kernel's event");

double speed_of(double share, double fastest) noexcept {
  const double beyond = (std::abs(share) - kDead) / (1 - kDead);
  if (!(beyond > 0)) return 0;
  return std::copysign(fastest * beyond * beyond, share);
}

}  // namespace

Capabilities GamepadDevice::capabilities() const {
  Capabilities able;
  able.position = able.rotation = true;
  able.vibration = pad_.controls && pad_.controls->can_rumble();
  able.rate_hz = 125;
  return able;
}

void GamepadDevice::open() {
  close();
  pad_ = open_();
  state_ = {};
  axes_.fill(0);
  ranges_ = {};
  rumble_ = 0;
  rumbled_ns_ = 0;
  is_dropping_ = false;
  event_count_ = 0;
  for (std::size_t i = 0; i < kAxes; ++i) {
    GamepadControls::Range range;
    if (pad_.controls->range(kAxisCodes[i], range) && range.least < range.most) ranges_[i] = range;
  }
}

void GamepadDevice::close() noexcept {
  if (pad_.controls && rumble_ > 0) pad_.controls->rumble(0);
  rumble_ = 0;
  pad_ = {};
}

void GamepadDevice::poll(Nanoseconds now, DeviceState& state) noexcept {
  if (pad_.link) {
    for (int events = 0; events < 64; ++events) {
      event_count_ += pad_.link->read({event_.data() + event_count_, event_.size() - event_count_});
      if (event_count_ < event_.size()) break;
      event_count_ = 0;
      input_event event;
      std::memcpy(&event, event_.data(), sizeof event);
      if (event.type == EV_SYN) {
        // Events were lost: what is between is not believed; a stick that moves again is.
        is_dropping_ = event.code == SYN_DROPPED;
        if (is_dropping_) {
          axes_.fill(0);
          state_.buttons = 0;
          ++state_.refused;
        } else {
          report(now);
        }
      } else if (!is_dropping_) {
        take(event.type, event.code, event.value);
      }
    }
    state_.health = pad_.link->is_gone() ? Health::Gone : Health::Good;
    // What was held when it went is held no more.
    if (state_.health == Health::Gone) {
      state_.velocity_mm_s = state_.spin_rad_s = {};
      state_.buttons = 0;
    }
  } else {
    state_.health = Health::Closed;
  }
  state = state_;
}

void GamepadDevice::take(std::uint16_t type, std::uint16_t code, std::int32_t value) noexcept {
  if (type == EV_ABS) {
    for (std::size_t i = 0; i < kAxes; ++i) {
      if (kAxisCodes[i] != code) continue;
      const GamepadControls::Range& range = ranges_[i];
      if (value < range.least || value > range.most) {
        ++state_.refused;
        return;
      }
      const double share = (static_cast<double>(value) - range.least) /
                           (static_cast<double>(range.most) - range.least);
      axes_[i] = i < kFirstTrigger ? 2 * share - 1 : share;
    }
  } else if (type == EV_KEY) {
    for (std::size_t i = 0; i < kPadButtons; ++i) {
      if (kButtonCodes[i] != code) continue;
      const std::uint32_t bit = 1U << i;
      state_.buttons = value != 0 ? state_.buttons | bit : state_.buttons & ~bit;
    }
  }
}

void GamepadDevice::report(Nanoseconds now) noexcept {
  // Left stick across, triggers up and down; right stick turns.
  const double up = axes_[5] - axes_[4];
  state_.velocity_mm_s = {speed_of(axes_[0], kFastestMmPerS), -speed_of(axes_[1], kFastestMmPerS),
                          speed_of(up, kFastestMmPerS)};
  state_.spin_rad_s = {-speed_of(axes_[3], kFastestRadPerS), speed_of(axes_[2], kFastestRadPerS),
                       0};
  state_.heard_ns = now;
  ++state_.samples;
}

void GamepadDevice::command(Nanoseconds now, const DeviceCommand& command) noexcept {
  if (!pad_.controls || !pad_.controls->can_rumble()) return;
  constexpr double kFullN = 1.0;
  constexpr double kLeastChange = 0.05;
  const double share = std::clamp(command.vibration_n / kFullN, 0.0, 1.0);
  const bool is_end = share == 0 && rumble_ > 0;
  if (std::abs(share - rumble_) < kLeastChange && !is_end) return;
  if (now - rumbled_ns_ < kRumbleNs && !is_end) return;
  pad_.controls->rumble(share);
  rumble_ = share;
  rumbled_ns_ = now;
}

}  // namespace carpus::devices
