// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/falcon_device.hpp"

#include <algorithm>
#include <cmath>

#include "devices/trusted_command.hpp"
#include "devices/trusted_state.hpp"

namespace carpus::devices {
namespace {

constexpr std::uint8_t kNibbleBase = 'A';
constexpr std::uint8_t kHoming = 0x01;
constexpr std::uint8_t kGreenLight = 0x02;
constexpr std::uint8_t kRedLight = 0x08;
/// A count is 0.1 N mm: what its drivers send for a newton metre is 10000.
constexpr double kCountsPerNMm = 10;
constexpr double kMostCounts = 4095;
constexpr double kVelocityFilterS = 0.005;
/// An answer that was lost: ask again.
constexpr Nanoseconds kAskAgainNs = 20 * kNsPerMs;

}  // namespace

bool read_falcon(const FalconFrame& frame, FalconSays& out) noexcept {
  if (frame.front() != '<' || frame.back() != '>') return false;
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const int nibble = frame[1 + 4 * i + k] - kNibbleBase;
      if (nibble < 0 || nibble > 15) return false;
      value |= static_cast<std::uint32_t>(nibble) << (4 * k);
    }
    out.counts[i] = static_cast<std::int16_t>(value);
  }
  const int state = frame[13] - kNibbleBase;
  if (state < 0 || state > 127) return false;
  out.buttons = static_cast<std::uint8_t>(state & 15);
  out.homed = static_cast<std::uint8_t>(state >> 4 & 7);
  return true;
}

FalconFrame falcon_frame(const std::array<std::int16_t, 3>& motors,
                         std::uint8_t lights_and_homing) noexcept {
  FalconFrame frame;
  frame.fill(kNibbleBase);
  frame.front() = '<';
  frame.back() = '>';
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = static_cast<std::uint16_t>(motors[i]);
    for (std::size_t k = 0; k < 4; ++k) {
      frame[1 + 4 * i + k] = static_cast<std::uint8_t>(kNibbleBase + (value >> (4 * k) & 15U));
    }
  }
  frame[13] = static_cast<std::uint8_t>(kNibbleBase + (lights_and_homing & 15U));
  return frame;
}

Capabilities FalconDevice::capabilities() const {
  Capabilities able;
  able.position = able.absolute = able.force = true;
  able.rate_hz = 1000;
  able.peak_force_n = 8;
  able.lasting_force_n = 4;
  able.most_stiffness_n_per_mm = 1.5;  // half of what its maker's loop holds: ours adds a frame
  able.workspace = {{-45, -45, -45}, {45, 45, 45}};
  return able;
}

void FalconDevice::open() {
  close();
  link_ = open_link_();
  state_ = {};
  frame_count_ = 0;
  tip_ = kFalconCentre;
  has_place_ = is_homed_ = is_impossible_ = is_asked_ = false;
  asked_ns_ = placed_ns_ = answered_ns_ = opened_ns_ = 0;
}

void FalconDevice::close() noexcept {
  if (link_) (void)link_->write(falcon_frame({}, kRedLight));
  link_.reset();
}

void FalconDevice::poll(Nanoseconds now, DeviceState& state) noexcept {
  if (!link_) {
    state_.health = Health::Closed;
    state = state_;
    return;
  }
  if (opened_ns_ == 0) opened_ns_ = now;
  std::array<std::uint8_t, 64> bytes;
  const std::size_t count = link_->read(bytes);
  for (std::size_t i = 0; i < count; ++i) take(now, bytes[i]);
  if (link_->is_gone()) {
    state_.health = Health::Gone;
  } else if (now - std::max(answered_ns_, opened_ns_) > 2 * kSilentNs) {
    state_.health = Health::Silent;
  } else if (answered_ns_ == 0) {
    state_.health = Health::Starting;
  } else if (!is_homed_) {
    state_.health = Health::Uncalibrated;
  } else {
    state_.health = is_impossible_ ? Health::Faulty : Health::Good;
  }
  state = state_;
}

void FalconDevice::take(Nanoseconds now, std::uint8_t byte) noexcept {
  if (frame_count_ == 0 && byte != '<') return;
  // A sign of a beginning within a frame: that one was cut short.
  if (frame_count_ > 0 && byte == '<') {
    ++state_.refused;
    frame_count_ = 0;
  }
  frame_[frame_count_++] = byte;
  if (frame_count_ < kFalconFrameBytes) return;
  frame_count_ = 0;
  take_frame(now);
}

void FalconDevice::take_frame(Nanoseconds now) noexcept {
  FalconSays says;
  if (!read_falcon(frame_, says)) {
    ++state_.refused;
    return;
  }
  answered_ns_ = now;
  if (is_asked_) state_.round_trip_us = static_cast<double>(now - asked_ns_) / 1000.0;
  is_asked_ = false;
  is_homed_ = says.homed == 7;
  state_.buttons = says.buttons;
  if (!is_homed_) {
    has_place_ = false;
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) angles_[i] = falcon_angle(says.counts[i]);
  auto tip = falcon_forward(angles_, tip_);
  if (!tip) tip = falcon_forward(angles_, kFalconCentre);
  constexpr double kFarthestOffMm = 120;
  is_impossible_ = !tip || !(distance(*tip, kFalconCentre) < kFarthestOffMm);
  Vec3 position;
  Vec3 velocity;
  double seconds = 0;
  if (!is_impossible_) {
    // Its x right, y up, z towards whoever sits there; ours x right, y away, z up.
    const Vec3 off = *tip - kFalconCentre;
    position = {off.x, -off.z, off.y};
    if (has_place_ && now > placed_ns_) {
      seconds = static_cast<double>(now - placed_ns_) * 1e-9;
      velocity = (position - state_.position_mm) / seconds;
      // Counts that leap: an encoder that slipped, or a frame that was damaged.
      is_impossible_ = !(length(velocity) < kFastestMmPerS);
    }
  }
  if (is_impossible_) {
    ++state_.refused;
    state_.velocity_mm_s = {};
    has_place_ = false;
    return;
  }
  tip_ = *tip;
  if (seconds > 0) {
    state_.velocity_mm_s +=
        (velocity - state_.velocity_mm_s) * std::min(1.0, seconds / kVelocityFilterS);
  } else {
    state_.velocity_mm_s = {};
  }
  state_.position_mm = position;
  state_.heard_ns = placed_ns_ = now;
  ++state_.samples;
  has_place_ = true;
}

void FalconDevice::command(Nanoseconds now, const DeviceCommand& command) noexcept {
  if (!link_ || (is_asked_ && now - asked_ns_ < kAskAgainNs)) return;
  std::array<std::int16_t, 3> motors{};
  std::uint8_t word = is_homed_ ? kGreenLight : kRedLight | kHoming;
  state_.force_n = {};
  if (has_place_) {
    const Vec3 force = force_of(command, state_.position_mm, state_.velocity_mm_s);
    const auto torques = falcon_torques(tip_, angles_, {force.x, force.z, -force.y});
    double most = 0;
    if (torques) {
      for (const double torque : *torques) most = std::max(most, std::abs(torque) * kCountsPerNMm);
    }
    if (torques && std::isfinite(most)) {
      // All alike, so that the force keeps its direction.
      const double share = most > kMostCounts ? kMostCounts / most : 1;
      for (std::size_t i = 0; i < 3; ++i) {
        motors[i] = static_cast<std::int16_t>(std::lround(-(*torques)[i] * kCountsPerNMm * share));
      }
      state_.force_n = force * share;
    }
  }
  if (!link_->write(falcon_frame(motors, word))) {
    ++state_.unsent;
    return;
  }
  is_asked_ = true;
  asked_ns_ = now;
}

}  // namespace carpus::devices
