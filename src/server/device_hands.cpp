// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/device_hands.hpp"

#include <algorithm>

#include "core/units.hpp"
#include "devices/precise_clock.hpp"
#include "haptics/virtual_coupling.hpp"

namespace carpus::server {
namespace {

using devices::Nanoseconds;
using simulation::HandInput;
using simulation::Snapshot;

/// After a longer rest (a pause, a lost tick) the device has been somewhere else: its moves count
/// anew from where it is.
constexpr Nanoseconds kEngageAnewNs = 100 * devices::kNsPerMs;
/// What a device said before this is not where it is now.
constexpr Nanoseconds kOldNs = 100 * devices::kNsPerMs;
/// No hand moves farther in a tick: what does is a device that lost its place.
constexpr double kMostMoveMm = 2.0;
/// A drill in bone is felt as so much, at its own rate [E].
constexpr double kDrillVibrationN = 0.25;
constexpr double kDrillVibrationHz = 90;
/// Bone that resists so much shakes the drill as much as it does.
constexpr double kFullResistanceN = 20;

struct Axes {
  Vec3 right;
  Vec3 away;
  Vec3 up;
};
Axes axes_of(const DeviceView& view) noexcept {
  const Vec3 right = normalized_or(view.right_in_patient, {1, 0, 0});
  const Vec3 up = normalized_or(view.up_in_patient - right * dot(right, view.up_in_patient),
                                any_perpendicular(right));
  return {right, cross(up, right), up};  // x right, y away, z up: right-handed
}
Vec3 to_patient(const Axes& axes, const Vec3& v) noexcept {
  return axes.right * v.x + axes.away * v.y + axes.up * v.z;
}
Vec3 to_device(const Axes& axes, const Vec3& v) noexcept {
  return {dot(axes.right, v), dot(axes.away, v), dot(axes.up, v)};
}

}  // namespace

void DeviceHands::before(simulation::Input& input, const Snapshot& last) noexcept {
  before_at(devices::monotonic_now(), input, last);
}
void DeviceHands::after(const Snapshot& now) noexcept { after_at(devices::monotonic_now(), now); }

void DeviceHands::before_at(Nanoseconds now,
                            simulation::Input& input,
                            const Snapshot& last) noexcept {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    DeviceView view;
    if (hand.views.take(view)) {
      if (view.revision != hand.view.revision) hand.is_engaged = false;
      hand.view = view;
    }
    (void)hand.exchange.states.take(hand.state);
    if (now - hand.ticked_ns > kEngageAnewNs) hand.is_engaged = false;
    hand.ticked_ns = now;
    if (hand.view.is_used) {
      guide(hand, now, input.hands[i], last, i);
    } else {
      hand.is_engaged = false;
    }
  }
}

void DeviceHands::engage(Hand& hand, const HandInput& input, const Snapshot& last) noexcept {
  const bool holds = hand.item < simulation::kMaxItems;
  hand.tip_anchor_mm = holds ? last.items[hand.item].tip_in_patient : input.tip_in_patient;
  hand.tip_in_patient = hand.tip_anchor_mm;
  hand.device_anchor_mm = hand.state.device.position_mm;
  hand.is_engaged = true;
}

void DeviceHands::guide(Hand& hand,
                        Nanoseconds now,
                        HandInput& input,
                        const Snapshot& last,
                        std::size_t index) noexcept {
  const devices::DeviceState& device = hand.state.device;
  const std::uint8_t item = last.hands[index].item;
  if (item != hand.item) hand.is_engaged = false;
  hand.item = item;
  const bool is_heard = devices::is_usable(device.health) &&
                        (!hand.state.able.absolute || now - device.heard_ns < kOldNs);
  if (!is_heard) {
    // The hand rests where it was, and drives nothing.
    if (hand.is_engaged) input.tip_in_patient = hand.tip_in_patient;
    input.driver = simulation::Driver::Off;
    input.guidance = simulation::Guidance::Direct;
    hand.device_anchor_mm = device.position_mm;
    hand.tip_anchor_mm = hand.tip_in_patient;
    return;
  }
  if (!hand.is_engaged) engage(hand, input, last);
  const Axes axes = axes_of(hand.view);
  Vec3 wish = hand.tip_in_patient;
  if (hand.state.able.absolute) {
    wish = hand.tip_anchor_mm + to_patient(axes, device.position_mm - hand.device_anchor_mm);
    // A device that jumps takes nothing with it: it goes on from where the hand is.
    if (!(distance(wish, hand.tip_in_patient) < kMostMoveMm)) {
      hand.tip_anchor_mm = hand.tip_in_patient;
      hand.device_anchor_mm = device.position_mm;
      wish = hand.tip_in_patient;
    }
  } else {
    wish += to_patient(axes, device.velocity_mm_s) * kTickSeconds;
  }
  hand.tip_in_patient = wish;
  input.tip_in_patient = wish;
  input.guidance = simulation::Guidance::Direct;
  if (hand.view.follows_turn && hand.state.able.rotation && hand.state.able.absolute) {
    input.shaft_in_patient = to_patient(axes, device.rotation.column(2));
  }
  hand.shaft_in_patient = input.shaft_in_patient;
  hand.driver = input.driver;
}

void DeviceHands::after_at(Nanoseconds now, const Snapshot& snapshot) noexcept {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    if (!hand.view.is_used || !hand.is_engaged) continue;
    devices::TimedCommand wish;
    wish.at_ns = now;
    const simulation::HandView& felt = snapshot.hands[i];
    const devices::Capabilities& able = hand.state.able;
    wish.command.limit_n = able.peak_force_n;
    const double force = length(felt.force_in_patient);
    if (felt.item < simulation::kMaxItems && force > 0) {
      const Axes axes = axes_of(hand.view);
      const simulation::ItemView& item = snapshot.items[felt.item];
      const Vec3 out = felt.force_in_patient / force;
      devices::LocalPlane& plane = wish.command.planes[0];
      plane.normal = to_device(axes, out);
      // Where the tip may be, as the device would say it.
      const Vec3 proxy =
          hand.device_anchor_mm + to_device(axes, item.tip_in_patient - hand.tip_anchor_mm);
      plane.offset_mm = dot(plane.normal, proxy);
      plane.stiffness_n_per_mm = haptics::kContactStiffnessNPerMm;
      plane.damping_n_s_per_mm = haptics::kContactDampingNSPerMm;
      plane.friction = 0.1;
      wish.command.plane_count = 1;
      if (hand.driver != simulation::Driver::Off && felt.resistance_n > 0) {
        const double share = std::min(1.0, felt.resistance_n / kFullResistanceN);
        wish.command.vibration_n = kDrillVibrationN * share;
        wish.command.vibration_hz = kDrillVibrationHz;
      }
    }
    hand.exchange.wishes.publish(wish);
  }
}

}  // namespace carpus::server
