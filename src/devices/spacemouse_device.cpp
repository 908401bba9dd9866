// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/spacemouse_device.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace carpus::devices {
namespace {

/// Pressed as far as it goes the cap says about 350.
constexpr double kFullScale = 350;
constexpr std::int32_t kMostBelieved = 2000;
constexpr double kFastestMmPerS = 40;
constexpr double kFastestRadPerS = 1.2;
constexpr std::int32_t kMostButtons = 32;

/// Fine near the middle; nothing where it rests not quite still.
double speed_of(std::int32_t value, double fastest) noexcept {
  constexpr double kDead = 0.03;
  const double share = std::min(1.0, std::abs(value / kFullScale));
  if (share < kDead) return 0;
  return std::copysign(fastest * share * share, value);
}

}  // namespace

Capabilities SpaceMouseDevice::capabilities() const {
  Capabilities able;
  able.position = able.rotation = true;
  able.rate_hz = 60;
  return able;
}

void SpaceMouseDevice::open() {
  link_.reset();
  state_ = {};
  event_count_ = 0;
  link_ = open_link_();
}

void SpaceMouseDevice::poll(Nanoseconds now, DeviceState& state) noexcept {
  if (link_) {
    for (int events = 0; events < 16; ++events) {
      event_count_ += link_->read({event_.data() + event_count_, kEventBytes - event_count_});
      if (event_count_ < kEventBytes) break;
      take_event(now);
      event_count_ = 0;
    }
    if (now - state_.heard_ns > kAtRestNs) state_.velocity_mm_s = state_.spin_rad_s = {};
    state_.health = link_->is_gone() ? Health::Gone : Health::Good;
  } else {
    state_.health = Health::Closed;
  }
  state = state_;
}

void SpaceMouseDevice::take_event(Nanoseconds now) noexcept {
  std::array<std::int32_t, 8> word;
  std::memcpy(word.data(), event_.data(), kEventBytes);
  if (word[0] == 0) {
    for (std::size_t i = 1; i <= 6; ++i) {
      if (word[i] > kMostBelieved || word[i] < -kMostBelieved) {
        ++state_.refused;
        return;
      }
    }
    // Its axes: x right, y up, z towards whoever sits there; ours: x right, y away, z up.
    state_.velocity_mm_s = {speed_of(word[1], kFastestMmPerS), -speed_of(word[3], kFastestMmPerS),
                            speed_of(word[2], kFastestMmPerS)};
    state_.spin_rad_s = {speed_of(word[4], kFastestRadPerS), -speed_of(word[6], kFastestRadPerS),
                         speed_of(word[5], kFastestRadPerS)};
  } else if ((word[0] == 1 || word[0] == 2) && word[1] >= 0 && word[1] < kMostButtons) {
    const std::uint32_t bit = 1U << static_cast<std::uint32_t>(word[1]);
    state_.buttons = word[0] == 1 ? state_.buttons | bit : state_.buttons & ~bit;
  } else {
    ++state_.refused;
    return;
  }
  state_.heard_ns = now;
  ++state_.samples;
}

}  // namespace carpus::devices
