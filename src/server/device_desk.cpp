// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/device_desk.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "records/utc_time.hpp"

namespace carpus::server {
namespace {

using std::chrono::steady_clock;

// The enumerations of protocol.json are in the order of the devices'.
static_assert(static_cast<int>(protocol::DeviceHealth::Gone) ==
              static_cast<int>(devices::Health::Gone));
static_assert(static_cast<int>(protocol::DeviceHealth::HoldingBack) ==
              static_cast<int>(devices::Health::HoldingBack));

static_assert(static_cast<int>(protocol::DeviceAim::Own) == static_cast<int>(Aim::Own));
static_assert(static_cast<int>(protocol::DeviceAim::Portal) == static_cast<int>(Aim::Portal));

constexpr std::array<const char*, simulation::kHands> kHandNames{"first", "second"};
constexpr double kMostUs = 1e9;
constexpr double kMostMm = 9999;
/// As many as a message holds.
constexpr std::size_t kMostFound = 64;

}  // namespace

void DeviceDesk::find() {
  asked_at_ = steady_clock::now();
  was_asked_ = true;
  told_at_ = {};
  if (!search_) return;
  found_ = devices::find_devices(*search_);
  found_.push_back({"haply", "Haply (its service on this machine)"});
  if (found_.size() > kMostFound) found_.resize(kMostFound);
}

void DeviceDesk::use(const protocol::UseDevice& wish) {
  Held& held = held_[static_cast<std::size_t>(wish.hand)];
  if (wish.device != held.id) {
    std::unique_ptr<devices::Device> device;
    std::string name;
    if (!wish.device.empty()) {
      const auto one = std::find_if(found_.begin(), found_.end(),
                                    [&](const auto& each) { return each.id == wish.device; });
      if (one == found_.end() || !search_) {
        throw InvalidInput("This station has no such device any more; open the list anew.");
      }
      const auto& other = held_[1 - static_cast<std::size_t>(wish.hand)];
      if (other.id == wish.device) throw InvalidInput("The other hand holds this device.");
      name = one->name;
      device = devices::make_device(wish.device, *search_);
    }
    const std::uint32_t revision = held.view.revision;
    held.calibration.reset();
    held.loop.reset();  // no force, and its line is free, before anything else
    held = Held{};
    held.view.revision = revision;
    held.id = wish.device;
    held.name = name;
    if (device) {
      held.loop = std::make_unique<devices::HostLoop>(
          std::move(device), &hands_.exchange(static_cast<std::size_t>(wish.hand)));
    }
  }
  if (wish.aim) held.wished_aim = static_cast<Aim>(*wish.aim);
  held.view.aim = aim_of(held);
  held.view.right_in_patient = wish.right;
  held.view.up_in_patient = wish.up;
  held.view.is_used = held.loop != nullptr;
  ++held.view.revision;
  hands_.set_view(static_cast<std::size_t>(wish.hand), held.view);
  told_at_ = {};
}

/// What was chosen, as far as the device is able to.
Aim DeviceDesk::aim_of(const Held& held) noexcept {
  const devices::Capabilities& able = held.state.able;
  const Aim best = best_aim(able);
  return held.wished_aim && can_aim(*held.wished_aim, able) ? *held.wished_aim : best;
}

DeviceDesk::Held& DeviceDesk::held(std::int64_t hand, bool time_passes) {
  Held& held = held_[static_cast<std::size_t>(hand)];
  if (!held.loop) throw InvalidInput("This hand holds no device.");
  if (time_passes) throw InvalidInput("Pause the operation first; then this can be done.");
  return held;
}

void DeviceDesk::test_wall(const protocol::TestWall& wish, bool time_passes) {
  Held& which = held(wish.hand, time_passes && wish.on);
  which.is_testing = wish.on;
  which.loop->test_wall(wish.on);
  told_at_ = {};
}

void DeviceDesk::calibrate(const protocol::Calibrate& wish, bool time_passes) {
  Held& which = held(wish.hand, time_passes);
  told_at_ = {};
  switch (wish.step) {
    case protocol::CalibrationStep::Begin:
      which.note.clear();
      which.is_testing = false;
      which.loop->test_wall(false);
      which.calibration = std::make_unique<devices::CalibrationDesk>(*which.loop, which.state,
                                                                     search_->calibrations);
      return;
    case protocol::CalibrationStep::Take:
      if (!which.calibration) throw InvalidInput("No calibration is going on; begin one.");
      return which.calibration->take();
    case protocol::CalibrationStep::Cancel:
      which.note = which.calibration && which.calibration->is_stored()
                       ? "Its place is stored; its motors were not evened anew."
                       : "Given up; what was known before stays.";
      which.calibration.reset();
      return;
  }
}

void DeviceDesk::end_trials() {
  for (Held& held : held_) {
    if (held.is_testing) held.loop->test_wall(false);
    held.is_testing = false;
    held.calibration.reset();
  }
}

std::optional<std::string> DeviceDesk::look() {
  std::optional<std::string> lost;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    Held& held = held_[i];
    if (!held.loop) continue;
    (void)held.loop->look(held.state);
    // What a device is able to do is known when it has said who it is.
    if (const Aim aim = aim_of(held); aim != held.view.aim) {
      held.view.aim = aim;
      hands_.set_view(i, held.view);
      told_at_ = {};
    }
    const bool is_well = devices::is_usable(held.state.device.health);
    if (is_well) {
      held.has_worked = true;
      held.is_lost = false;
    } else if (held.has_worked && !held.is_lost && !held.calibration) {
      held.is_lost = true;
      held.is_testing = false;
      held.loop->test_wall(false);
      told_at_ = {};
      lost = "The " + held.name + " in the " + kHandNames[i] + " hand is " +
             devices::in_words(held.state.device.health);
    }
    if (held.calibration && held.calibration->look(records::utc_now(), held.state)) {
      held.calibration.reset();
      held.note = "Calibrated; it is stored for this device.";
      told_at_ = {};
    }
  }
  return lost;
}

std::string DeviceDesk::why_not_go_on() const {
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (!held_[i].is_lost) continue;
    return "The " + held_[i].name + " in the " + kHandNames[i] + " hand is " +
           devices::in_words(held_[i].state.device.health);
  }
  return {};
}

bool DeviceDesk::is_due() {
  const auto now = steady_clock::now();
  const bool holds = held_[0].loop || held_[1].loop;
  if (!holds && (!was_asked_ || now - asked_at_ > kTellFor) &&
      told_at_ != steady_clock::time_point{})
    return false;
  if (!holds && !was_asked_) return false;
  if (now - told_at_ < kTellEvery) return false;
  told_at_ = now;
  return true;
}

protocol::HandDevice DeviceDesk::describe(const Held& held) const {
  protocol::HandDevice out;
  out.id = held.id;
  out.name = held.name;
  if (!held.loop) return out;
  const devices::LoopState& state = held.state;
  const devices::LoopTiming& timing = state.timing;
  out.health = static_cast<protocol::DeviceHealth>(state.device.health);
  out.words = devices::in_words(state.device.health);
  const std::string advice = devices::what_to_do(state.device.health);
  const std::string problem = held.loop->problem();
  // That it is not there is said already.
  if (!problem.empty() && !problem.ends_with("plug the device in")) {
    out.words += ": " + problem;
  } else if (!advice.empty()) {
    out.words += ". " + advice;
  }
  out.can = devices::in_words(state.able);
  out.rate_hz = std::clamp(timing.rate_hz, 0.0, 1e5);
  out.late_p99_us = std::clamp(timing.late_p99_us, 0.0, kMostUs);
  out.late_p999_us = std::clamp(timing.late_p999_us, 0.0, kMostUs);
  out.missed = static_cast<std::int64_t>(std::min<std::uint64_t>(timing.missed, 1U << 30U));
  out.round_trip_us = std::clamp(timing.round_trip_p50_us, 0.0, kMostUs);
  out.real_time = timing.scheduling == devices::SchedulingClass::Fifo;
  const Vec3 given =
      squared_length(state.device.force_n) > 0 ? state.device.force_n : state.asked_force_n;
  out.force_n = std::clamp(length(given), 0.0, 1000.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.force[axis] = std::clamp(given[axis], -999.0, 999.0);
  }
  out.aim = static_cast<protocol::DeviceAim>(held.view.aim);
  out.has_portal = can_aim(Aim::Portal, state.able);
  out.has_rotation = can_aim(Aim::Own, state.able);
  out.most_force_n = std::clamp(state.able.peak_force_n, 0.0, 1000.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.position_mm[axis] = std::clamp(state.device.position_mm[axis], -kMostMm, kMostMm);
  }
  out.is_testing = held.is_testing;
  out.may_calibrate = state.device.has_unit;
  if (held.calibration) {
    out.calibration = held.calibration->instruction();
    out.calibration_note = held.calibration->note();
  } else {
    out.calibration_note = held.note;
  }
  return out;
}

protocol::Devices DeviceDesk::message() const {
  protocol::Devices out;
  for (const devices::FoundDevice& one : found_) out.found.push_back({one.id, one.name});
  for (const Held& held : held_) out.hands.push_back(describe(held));
  return out;
}

}  // namespace carpus::server
