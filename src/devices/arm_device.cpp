// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/arm_device.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "arm/arm_weight.hpp"
#include "arm/cogging.hpp"
#include "core/units.hpp"
#include "firmware/core/tool_roll.hpp"

namespace carpus::devices {
namespace {

using firmware::Drive;

constexpr double kUnitsPerRad = 8192 / kPi;
/// Of potentiometers' angles, each millisecond: 5 ms.
constexpr double kAngleFilter = 0.2;
/// Of the tip's velocity: 20 ms.
constexpr double kVelocityFilterS = 0.02;
constexpr double kMostVelocityMmPerS = 5000;
/// Beyond its limits by more than this a leg cannot be: the wrong turn of a motor, a slipped
/// sensor.
constexpr double kMostBeyondRad = 0.2;

/// Of the encoders' rates, each millisecond: 5 ms.
constexpr double kRateFilter = 0.2;
/// From a report of drive B until the middle of the tick for which the answer to it acts: both
/// frames' way, the host's wait, half a tick, the current's delay.
constexpr double kAheadS = 0.0031;

std::int16_t rounded16(double value, double most) noexcept {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -most, most)));
}
/// A leg that is told such numbers sees itself at angle 0 always, and turns its servo to where a
/// stop on its side is, however the sensor stands: 350 us to either side, slowly, as if it pushed.
constexpr std::int16_t kTurnUsPerHalfTurn = 24'000;
constexpr std::uint16_t kTurnMiddleUs = 1500;
constexpr int kTurnMostUs = 350;
constexpr std::uint8_t kTurnConfigs = 9;  ///< three times each leg, as a frame may be lost

firmware::LegConfig turning_config(std::uint8_t leg) noexcept {
  firmware::LegConfig config;
  config.leg = leg;
  config.zero_counts = 2046;
  config.gain = 1;
  config.pulse_at_zero_us = kTurnMiddleUs;
  config.pulse_per_turn_us = kTurnUsPerHalfTurn;
  config.least_pulse_us = kTurnMiddleUs - kTurnMostUs;
  config.most_pulse_us = kTurnMiddleUs + kTurnMostUs;
  return config;
}

firmware::Stop turning_stop(int pulse_us) noexcept {
  const int off = std::clamp(pulse_us - int{kTurnMiddleUs}, -kTurnMostUs, kTurnMostUs);
  firmware::Stop stop;
  for (firmware::LegStop& leg : stop.legs) {
    leg.side = off < 0 ? firmware::LegStopSide::NotAbove : firmware::LegStopSide::NotBelow;
    leg.angle = rounded16(off * 8192.0 / kTurnUsPerHalfTurn, 8191);
  }
  return stop;
}

std::uint16_t roundedu16(double value, double most) noexcept {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, most)));
}

firmware::LegConfig config_of(const ArmCalibration& calibration, std::uint8_t leg) noexcept {
  const ServoFit& servo = calibration.servos[leg];
  firmware::LegConfig config;
  config.leg = leg;
  config.pulse_at_zero_us = roundedu16(servo.pulse_at_zero_us, 2100);
  config.pulse_per_turn_us = rounded16(servo.pulse_per_half_turn_us, 32767);
  config.gap = roundedu16(servo.gap_rad * kUnitsPerRad, 2048);
  config.least_pulse_us = roundedu16(servo.least_pulse_us, 2100);
  config.most_pulse_us = roundedu16(servo.most_pulse_us, 2100);
  put_line(calibration.legs[leg], config);
  return config;
}

}  // namespace

ArmDevice::ArmDevice(OpenLink open_link, std::filesystem::path calibrations)
    : open_link_(std::move(open_link)), folder_(std::move(calibrations)) {}

ArmDevice::~ArmDevice() { close(); }

Capabilities ArmDevice::capabilities() const {
  Capabilities able;
  able.position = true;
  able.absolute = true;
  able.roll = true;
  able.rate_hz = 1000;
  able.workspace = {{-50, -50, -40}, {50, 50, 40}};
  const bool is_motor = identity_ && identity_->drive == static_cast<std::uint8_t>(Drive::Motor);
  able.stop = !is_motor;
  able.force = is_motor;
  able.local_plane = true;
  able.vibration = is_motor;
  able.peak_force_n = is_motor ? 8.0 : 2.4;
  able.lasting_force_n = is_motor ? 2.9 : 2.4;
  able.most_stiffness_n_per_mm = is_motor ? 2.0 : 10.0;
  return able;
}

void ArmDevice::open() {
  close();
  problems_.clear();
  calibrations_ = load_calibrations(folder_, problems_);
  link_ = open_link_();
  decoder_ = {};
  identity_.reset();
  calibration_ = nullptr;
  state_ = {};
  phase_ = Phase::Greeting;
  status_ = 0;
  has_place_ = is_impossible_ = false;
  turn_configs_ = 0;
  unfelt_n_ = {};
  opened_ns_ = greeted_ns_ = placed_ns_ = answered_ns_ = 0;
  sent_ns_.fill(0);
}

void ArmDevice::close() noexcept {
  if (!link_) return;
  std::uint8_t bytes[firmware::kMaxFrameBytes];
  const std::uint8_t count = firmware::encode_frame(firmware::Release{}, ++sequence_, bytes);
  (void)link_->write({bytes, count});
  link_.reset();
}

template <typename Frame>
bool ArmDevice::send(Nanoseconds now, const Frame& frame) noexcept {
  std::uint8_t bytes[firmware::kMaxFrameBytes];
  const auto sequence = static_cast<std::uint8_t>(sequence_ + 1);
  const std::uint8_t count = firmware::encode_frame(frame, sequence, bytes);
  if (!link_->write({bytes, count})) {
    ++state_.unsent;
    return false;
  }
  sequence_ = sequence;
  sent_ns_[sequence] = now;
  return true;
}

void ArmDevice::greet(Nanoseconds now) noexcept {
  if (greeted_ns_ != 0 && now - greeted_ns_ < kGreetAgainNs) return;
  greeted_ns_ = now;
  (void)send(now, firmware::Hello{firmware::kProtocolVersion});
}

void ArmDevice::poll(Nanoseconds now, DeviceState& state) noexcept {
  if (link_) {
    if (opened_ns_ == 0) opened_ns_ = now;
    std::uint8_t bytes[kReadAtOnce];
    const std::size_t count = link_->read(bytes);
    for (std::size_t i = 0; i < count; ++i) {
      decoder_.push(bytes[i]);
      while (decoder_.next()) take_frame(now);
    }
  }
  state_.health = health_at(now);
  state = state_;
  state.refused += decoder_.refused();
}

void ArmDevice::take_frame(Nanoseconds now) noexcept {
  firmware::Identity identity;
  firmware::Sensors sensors;
  firmware::Motion motion;
  firmware::Alignment alignment;
  if (decoder_.read_frame(identity)) {
    take(now, identity);
  } else if (decoder_.read_frame(sensors)) {
    take(now, sensors);
  } else if (decoder_.read_frame(motion)) {
    take(now, motion);
  } else if (decoder_.read_frame(alignment)) {
    take(now, alignment);
  } else {
    ++state_.refused;
  }
}

void ArmDevice::take(Nanoseconds now, const firmware::Identity& identity) noexcept {
  identity_ = identity;
  state_.unit = identity.unit;
  state_.has_unit = true;
  answered_ns_ = now;
  calibration_ = nullptr;
  for (const ArmCalibration& one : calibrations_) {
    if (one.unit == identity.unit && static_cast<std::uint8_t>(one.drive) == identity.drive) {
      calibration_ = &one;
    }
  }
  phase_ = identity.version == firmware::kProtocolVersion ? Phase::Configuring : Phase::Greeting;
  next_leg_ = 0;
  has_sent_ = has_config_ = {};
  turn_configs_ = 0;
  status_ = 0;
  has_place_ = false;
}

void ArmDevice::heard(Nanoseconds now, std::uint8_t echo, std::uint8_t status) noexcept {
  status_ = status;
  answered_ns_ = now;
  ++state_.raw_samples;
  if (sent_ns_[echo] != 0) {
    state_.round_trip_us = static_cast<double>(now - sent_ns_[echo]) / 1000.0;
    sent_ns_[echo] = 0;
  }
  // It was reset meanwhile: what it was told is forgotten.
  if ((status & firmware::kStatusAfterReset) != 0 && phase_ != Phase::Greeting) {
    phase_ = Phase::Greeting;
    greeted_ns_ = 0;
    has_place_ = false;
  }
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    if (has_sent_[leg] && config_sequences_[leg] == echo) has_config_[leg] = true;
  }
  // A device that was configured before may have had other numbers.
  const bool is_told = identity_ && (identity_->drive != static_cast<std::uint8_t>(Drive::Stop) ||
                                     (has_config_[0] && has_config_[1] && has_config_[2]));
  if (is_told && phase_ == Phase::Configuring && calibration_ != nullptr &&
      (status & firmware::kStatusConfigured) != 0 && is_homed_by_us()) {
    phase_ = Phase::Working;
  }
}

void ArmDevice::take(Nanoseconds now, const firmware::Sensors& sensors) noexcept {
  if (!identity_ || identity_->drive != static_cast<std::uint8_t>(Drive::Stop)) {
    ++state_.refused;
    return;
  }
  for (std::size_t i = 0; i < kLegs; ++i) state_.raw_counts[i] = sensors.legs[i].counts;
  take_roll(firmware::roll_of(sensors.legs));
  heard(now, sensors.echo, sensors.status);
  if (phase_ != Phase::Working || (sensors.status & firmware::kStatusSensorFault) != 0) return;
  arm::LegAngles angles{};
  for (std::size_t i = 0; i < kLegs; ++i) {
    angles[i] = calibration_->legs[i].angle_at(sensors.legs[i].counts);
    if (has_place_) angles[i] = angles_[i] + kAngleFilter * (angles[i] - angles_[i]);
  }
  place(now, angles);
}

void ArmDevice::take(Nanoseconds now, const firmware::Motion& motion) noexcept {
  if (!identity_ || identity_->drive != static_cast<std::uint8_t>(Drive::Motor)) {
    ++state_.refused;
    return;
  }
  for (std::size_t i = 0; i < kLegs; ++i) state_.raw_counts[i] = motion.counts[i];
  take_roll(motion.roll);
  heard(now, motion.echo, motion.status);
  const Vec3 given =
      Vec3{static_cast<double>(motion.force_mn[0]), static_cast<double>(motion.force_mn[1]),
           static_cast<double>(motion.force_mn[2])} *
      0.001;
  // What carries the arm, and evens its motors, is not felt: that of the command which this answers
  // to, or a fast hand would seem to be given energy and the net would take the surface away.
  state_.force_n = squared_length(given) > 0 ? given - unfelt_n_[motion.echo] : Vec3{};
  state_.hottest_c = motion.hottest_c;
  if (phase_ != Phase::Working || (motion.status & firmware::kStatusSensorFault) != 0) return;
  arm::LegAngles angles{};
  for (std::size_t i = 0; i < kLegs; ++i) {
    angles[i] = (motion.counts[i] - home_[i]) * kRadPerMotorCount;
  }
  place(now, angles);
}

void ArmDevice::take(Nanoseconds now, const firmware::Alignment& alignment) noexcept {
  if (!identity_ || identity_->drive != static_cast<std::uint8_t>(Drive::Motor)) {
    ++state_.refused;
    return;
  }
  state_.windings.progress = alignment.progress;
  for (std::size_t i = 0; i < kLegs; ++i) {
    state_.windings.electrical_zero[i] = alignment.electrical_zero[i];
    state_.windings.windings[i] = alignment.windings_found[i];
  }
  heard(now, alignment.echo, alignment.status);
}

void ArmDevice::take_roll(std::uint16_t roll) noexcept {
  state_.roll_rad = roll * (2 * kPi / firmware::kRollsOfTurn);
}

/// What a device of drive B was told by another program is not known here.
bool ArmDevice::is_homed_by_us() const noexcept {
  return calibration_->drive == Drive::Stop || homed_unit_ == calibration_->unit;
}

void ArmDevice::place(Nanoseconds now, const arm::LegAngles& angles) noexcept {
  const auto tip = arm::forward(arm_, angles);
  is_impossible_ = !tip || !is_finite(*tip);
  for (const double angle : angles) {
    if (!(angle > arm_.least_angle - kMostBeyondRad && angle < arm_.most_angle + kMostBeyondRad)) {
      is_impossible_ = true;
    }
  }
  if (is_impossible_) {
    ++state_.refused;
    has_place_ = false;
    state_.velocity_mm_s = {};
    return;
  }
  const Vec3 position = *tip - arm_.centre;
  weight_n_ = arm::force_at_tip(arm_, angles, arm::weight_left(arm_, angles, arm::kMotorArmWeight));
  const arm::LegAngles before = angles_;
  angles_ = angles;
  if (!has_place_) rates_ = {};
  if (has_place_ && now > placed_ns_) {
    const double seconds = static_cast<double>(now - placed_ns_) * 1e-9;
    for (std::size_t i = 0; i < kLegs; ++i) {
      rates_[i] += ((angles[i] - before[i]) / seconds - rates_[i]) * kRateFilter;
    }
    const Vec3 velocity = (position - state_.position_mm) / seconds;
    const double share = std::min(1.0, seconds / kVelocityFilterS);
    state_.velocity_mm_s += (velocity - state_.velocity_mm_s) * share;
    if (!(length(state_.velocity_mm_s) < kMostVelocityMmPerS)) state_.velocity_mm_s = {};
  }
  state_.position_mm = position;
  state_.heard_ns = placed_ns_ = now;
  ++state_.samples;
  has_place_ = true;
}

void ArmDevice::configure(Nanoseconds now) noexcept {
  if (calibration_ == nullptr) {
    (void)send(now, firmware::Release{});
  } else if (calibration_->drive == Drive::Stop) {
    if (send(now, config_of(*calibration_, next_leg_))) {
      config_sequences_[next_leg_] = sequence_;
      has_sent_[next_leg_] = true;
      next_leg_ = static_cast<std::uint8_t>((next_leg_ + 1) % kLegs);
    }
  } else if (state_.raw_samples == 0) {
    (void)send(now, firmware::Release{});  // its counts come first
  } else {
    firmware::Home home;
    homed_unit_ = identity_->unit;
    for (std::size_t i = 0; i < kLegs; ++i) {
      home_[i] = home_of(calibration_->zero_in_turn[i], state_.raw_counts[i]);
      home.zero_counts[i] = std::clamp(home_[i], -1000000, 1000000);
      home.electrical_zero[i] = calibration_->windings[i].electrical_zero;
      home.windings[i] = static_cast<std::uint8_t>(calibration_->windings[i].windings);
    }
    (void)send(now, home);
  }
}

void ArmDevice::turn_servos_now(Nanoseconds now) noexcept {
  if (turn_configs_ == kTurnConfigs) {
    (void)send(now, turning_stop(pulse_us_));
  } else if ((status_ & firmware::kStatusDriving) != 0) {
    (void)send(now, firmware::Release{});  // a leg that drives is not told anything new
  } else if (send(now, turning_config(static_cast<std::uint8_t>(turn_configs_ % kLegs)))) {
    ++turn_configs_;
  }
}

haptics::HapticWish ArmDevice::wish_of(const DeviceCommand& command) const noexcept {
  haptics::HapticWish wish;
  wish.plane_count = std::min<std::size_t>(command.plane_count, kMostPlanes);
  for (std::size_t i = 0; i < wish.plane_count; ++i) {
    const LocalPlane& plane = command.planes[i];
    wish.planes[i].normal = plane.normal;
    wish.planes[i].offset_mm = plane.offset_mm + dot(plane.normal, arm_.centre);
    const double stiffness = plane.stiffness_n_per_mm;
    wish.planes[i].feel = {stiffness, stiffness > 0 ? plane.damping_n_s_per_mm / stiffness : 0,
                           plane.friction};
  }
  wish.besides_n = command.force_n;
  wish.limit_n = command.limit_n;
  wish.vibration_n = command.vibration_n;
  wish.vibration_hz = command.vibration_hz;
  return wish;
}

/// One plane at a time is all that stops can be: the one that the tip is deepest in or nearest to.
firmware::Stop ArmDevice::stops_of(const haptics::HapticWish& wish) noexcept {
  const Vec3 tip = state_.position_mm + arm_.centre;
  const haptics::SurfacePlane* nearest = nullptr;
  double least = haptics::kNearSurfaceMm;
  for (std::size_t i = 0; i < wish.plane_count; ++i) {
    const double height = dot(wish.planes[i].normal, tip) - wish.planes[i].offset_mm;
    if (!(wish.planes[i].feel.stiffness_n_per_mm > 0) || !(height < least)) continue;
    least = height;
    nearest = &wish.planes[i];
  }
  // Free legs are a wish too: the slots follow the legs, so that the hand feels nothing.
  if (nearest == nullptr) return stops_.free();
  return stops_.at(arm_, *nearest, angles_, tip, state_.velocity_mm_s);
}

void ArmDevice::command(Nanoseconds now, const DeviceCommand& command) noexcept {
  if (!link_) return;
  if (phase_ == Phase::Greeting) return greet(now);
  const bool is_stop = identity_->drive == static_cast<std::uint8_t>(Drive::Stop);
  if (pulse_us_ != 0 && is_stop) return turn_servos_now(now);
  if (pulse_us_ != 0) return (void)send(now, firmware::Align{});
  state_.windings.progress = 0;
  if (turn_configs_ != 0) {  // as usual again: from the beginning
    turn_configs_ = 0;
    phase_ = Phase::Greeting;
    greeted_ns_ = 0;
    has_place_ = false;
    return greet(now);
  }
  if (phase_ == Phase::Configuring) return configure(now);
  const bool is_nothing = !(command.limit_n > 0) || !has_place_;
  haptics::HapticWish wish = wish_of(is_nothing ? DeviceCommand{} : command);
  if (calibration_->drive == Drive::Stop) {
    (void)send(now, stops_of(wish));
    return;
  }
  // The arm's own weight is carried whatever is wished, or it would fall while an exercise pauses.
  Vec3 unfelt_n;
  if (has_place_) {
    const Vec3 smooth_n =
        arm::against_cogging(arm_, calibration_->cogging, angles_, rates_, kAheadS);
    unfelt_n = weight_n_ + smooth_n;
    wish.besides_n += unfelt_n;
    wish.limit_n += length(weight_n_) + length(smooth_n);
  }
  if (wish.plane_count == 0) net_.close();
  const double share = net_.share(state_.force_n, state_.position_mm);
  if (send(now, haptics::contact_frame(wish, share, limiter_))) unfelt_n_[sequence_] = unfelt_n;
}

Health ArmDevice::health_at(Nanoseconds now) const noexcept {
  if (!link_) return Health::Closed;
  if (link_->is_gone()) return Health::Gone;
  if (identity_ && identity_->version != firmware::kProtocolVersion) return Health::Faulty;
  const Nanoseconds last = std::max(answered_ns_, opened_ns_);
  // A board that resets when its line is opened takes two seconds to say anything.
  constexpr Nanoseconds kStartNs = 3000 * kNsPerMs;
  const bool is_starting = answered_ns_ == 0;
  if (now - last > (is_starting ? kStartNs : kSilentNs)) return Health::Silent;
  if (is_starting || phase_ == Phase::Greeting) return Health::Starting;
  if ((status_ & firmware::kStatusSensorFault) != 0 || is_impossible_) return Health::Faulty;
  if (calibration_ == nullptr) return Health::Uncalibrated;
  if (phase_ != Phase::Working || !has_place_) return Health::Starting;
  const unsigned held = firmware::kStatusHot | firmware::kStatusLimited | firmware::kStatusTooFast;
  return (status_ & held) != 0 ? Health::HoldingBack : Health::Good;
}

}  // namespace carpus::devices
