// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/device_hands.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "devices/precise_clock.hpp"
#include "instruments/instrument.hpp"

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
/// The scope follows its handle by steps of this, several counts of the roll's twelve bits: what
/// flickers turns nothing.
constexpr double kTurnStepDeg = 0.5;
/// Recordings hold angles to 1/16384: what differs by more was turned by somebody else.
constexpr double kSameTurnDeg = 0.01;
/// As the world takes it.
constexpr double kMostThrustN = 60;
/// What the tool is held back by is more than this, or it is rounding [mm].
constexpr double kHeldMm = 0.002;

// The drives are in the order of what turns a tool.
static_assert(static_cast<int>(instruments::Drive::Powered) ==
              static_cast<int>(haptics::TurnedBy::Motor));
static_assert(static_cast<int>(instruments::Drive::ByHand) ==
              static_cast<int>(haptics::TurnedBy::Hand));

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
/// The same angle in -180 to 180 degrees.
double half_turn(double degrees) noexcept { return std::remainder(degrees, 360.0); }
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
      turn_scope(hand, input.command, last, i);
    } else {
      hand.is_engaged = false;
      hand.turns_scope = false;
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
  if (item != hand.item) {
    hand.is_engaged = false;
    hand.aim.forget();
    hand.feel.rest();
  }
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
  AimMoment aim;
  aim.tip = wish;
  aim.page_shaft = input.shaft_in_patient;
  aim.own_shaft = to_patient(axes, device.rotation.column(2));
  aim.own_spin_rad_s = to_patient(axes, device.spin_rad_s);
  aim.is_at_bone =
      item < simulation::kMaxItems && (last.hands[index].ahead.body != simulation::kNoBody ||
                                       last.items[item].body != simulation::kNoBody);
  input.shaft_in_patient = hand.aim.shaft(hand.view.aim, hand.state.able, aim);
  hand.driver = input.driver;
  press(hand, input, last);
}

void DeviceHands::turn_scope(Hand& hand,
                             simulation::Command& command,
                             const Snapshot& last,
                             std::size_t index) noexcept {
  const bool is_told =
      hand.is_engaged && devices::is_usable(hand.state.device.health) && hand.state.able.roll;
  if (!is_told || last.finished || last.scope.hand != index) {
    hand.turns_scope = false;
    return;
  }
  const double roll_deg = degrees_from_radians(hand.state.device.roll_rad);
  const double now_deg = last.scope.shaft_turn_deg;
  // Taken just now, or turned by the page: it goes on from there.
  if (!hand.turns_scope || !(std::abs(half_turn(now_deg - hand.turned_deg)) < kSameTurnDeg)) {
    hand.turns_scope = true;
    hand.roll_anchor_deg = roll_deg;
    hand.turn_anchor_deg = hand.turned_deg = now_deg;
    return;
  }
  const double wish_deg = half_turn(hand.turn_anchor_deg + roll_deg - hand.roll_anchor_deg);
  if (!(std::abs(half_turn(wish_deg - now_deg)) >= kTurnStepDeg)) return;
  if (command.kind != simulation::CommandKind::None) return;
  command.kind = simulation::CommandKind::TurnScope;
  command.hand = static_cast<std::uint8_t>(index);
  command.rotation_deg = wish_deg;
  command.tilt_deg = last.scope.camera_turn_deg;
  hand.turned_deg = wish_deg;
}

/// What a hand presses along the shaft, where the device can answer it.
void DeviceHands::press(const Hand& hand, HandInput& input, const Snapshot& last) noexcept {
  const devices::Capabilities& able = hand.state.able;
  if (!able.force || !able.absolute || hand.item >= simulation::kMaxItems) return;
  const simulation::ItemView& item = last.items[hand.item];
  haptics::FeltMoment moment;
  moment.tip = item.tip_in_patient;
  moment.wish = hand.tip_in_patient;
  moment.shaft = item.shaft_in_patient;
  const haptics::FeelTable& table = haptics::feel_table();
  double stiffness = table.bone.feel.stiffness_n_per_mm;
  if (able.most_stiffness_n_per_mm > 0)
    stiffness = std::min(stiffness, able.most_stiffness_n_per_mm);
  const double pressed = std::min(haptics::press_n(moment, stiffness), able.peak_force_n);
  input.thrust_n = std::min(haptics::thrust_of_press_n(table.drilling, pressed, able.peak_force_n),
                            kMostThrustN);
}

haptics::FeltMoment DeviceHands::moment_of(Hand& hand,
                                           const Snapshot& snapshot,
                                           std::size_t index) noexcept {
  const simulation::HandView& felt = snapshot.hands[index];
  const simulation::ItemView& item = snapshot.items[felt.item];
  haptics::FeltMoment moment;
  moment.tip = item.tip_in_patient;
  moment.wish = hand.tip_in_patient;
  moment.shaft = item.shaft_in_patient;
  moment.is_in_bone = item.body != simulation::kNoBody;
  moment.is_held_back =
      squared_length(felt.force_in_patient) > 0 || felt.contact_depth_mm > kHeldMm;
  moment.most_n_per_mm = hand.state.able.most_stiffness_n_per_mm;
  moment.near = {felt.ahead.body != simulation::kNoBody, felt.ahead.gap_mm,
                 felt.ahead.normal_in_patient,
                 felt.ahead.facing_mm < haptics::feel_table().joint_gap_mm};
  const auto catalogue = instruments::catalogue();
  if (item.instrument >= catalogue.size()) return moment;
  const instruments::Instrument& kind = catalogue[item.instrument];
  moment.is_pointed = kind.work == instruments::Work::Drill;
  moment.turned_by = static_cast<haptics::TurnedBy>(kind.drive);
  // A device that can turn back needs no ticks.
  if (hand.state.able.torque && kind.drive == instruments::Drive::ByHand)
    moment.turned_by = haptics::TurnedBy::Nothing;
  moment.is_turning = hand.driver != simulation::Driver::Off;
  moment.resistance_n = felt.resistance_n;
  const double fed_mm = std::abs(item.depth_mm - hand.depth_mm);
  if (kind.feed.fastest_mm_per_s > 0)
    moment.feed_share = fed_mm / (kind.feed.fastest_mm_per_s * kTickSeconds);
  hand.depth_mm = item.depth_mm;
  if (const auto& thread = kind.shape.thread()) moment.turns = item.depth_mm / thread->pitch_mm;
  moment.torque_n_mm = felt.torque_n_mm;
  return moment;
}

void DeviceHands::after_at(Nanoseconds now, const Snapshot& snapshot) noexcept {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    if (!hand.view.is_used || !hand.is_engaged) continue;
    devices::TimedCommand wish;
    wish.at_ns = now;
    devices::DeviceCommand& command = wish.command;
    command.limit_n = hand.state.able.peak_force_n;
    if (snapshot.hands[i].item < simulation::kMaxItems) {
      const Axes axes = axes_of(hand.view);
      const haptics::Felt felt = hand.feel.feel(moment_of(hand, snapshot, i));
      // Where a plane of the patient lies, as the device would say it.
      const auto place = [&](const haptics::SurfacePlane& plane) {
        const Vec3 normal = to_device(axes, plane.normal);
        const double away = plane.offset_mm - dot(plane.normal, hand.tip_anchor_mm);
        const double stiffness = plane.feel.stiffness_n_per_mm;
        return devices::LocalPlane{normal, dot(normal, hand.device_anchor_mm) + away, stiffness,
                                   stiffness * plane.feel.damping_s, plane.feel.friction};
      };
      for (std::size_t k = 0; k < felt.plane_count; ++k) command.planes[k] = place(felt.planes[k]);
      command.plane_count = static_cast<std::uint8_t>(felt.plane_count);
      command.vibration_n = felt.vibration_n;
      command.vibration_hz = felt.vibration_hz;
      command.torque_n_mm = snapshot.hands[i].torque_n_mm;
    }
    hand.exchange.wishes.publish(wish);
  }
}

}  // namespace carpus::server
