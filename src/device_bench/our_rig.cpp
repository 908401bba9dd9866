// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A tick: who is there -> its calibration -> what it shall render, from what it last said. Then the
// line, and 1 ms of firmware and plant.
#include "device_bench/our_rig.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_weight.hpp"
#include "arm/cogging.hpp"
#include "core/units.hpp"
#include "firmware/core/frame_encoder.hpp"
#include "firmware/core/motor_arm.hpp"

namespace carpus::device_bench {
namespace {

constexpr double kTickUs = 1000;
/// Every part has settled, the board has started.
constexpr int kStartMs = 60;
constexpr double kAnswerIsOldUs = 50e3;
constexpr std::uint64_t kHelloTicks = 5;
/// Of the potentiometers' angles: 5 ms; of the velocity: 20 ms.
constexpr double kAngleFilter = 0.2;
constexpr double kVelocityFilter = 0.05;
/// Of the encoders' rates: 5 ms.
constexpr double kRateFilter = 0.2;
/// From a report of drive B until the middle of the tick for which the answer to it acts: both
/// frames' way, the host's wait, half a tick, the current's delay.
constexpr double kAheadS = 0.0031;
constexpr std::size_t kMostTimes = 20'000;

std::unique_ptr<virtual_arm::VirtualArm> make_arm(const RigOptions& options) {
  virtual_arm::VirtualArmOptions of_arm;
  of_arm.seed = options.seed;
  of_arm.hand = options.hand;
  if (options.drive == firmware::Drive::Motor) return virtual_arm::make_virtual_motor_arm(of_arm);
  return virtual_arm::make_virtual_stop_arm(of_arm, options.board ? options.board() : nullptr);
}

}  // namespace

OurRig::OurRig(const RigOptions& options)
    : Rig(options), arm_(make_arm(options)), line_rng_(1000 + options.seed) {
  for (int leg = 0; leg < 3; ++leg) {
    calibrations_[static_cast<std::size_t>(leg)] = arm_->leg_calibration(leg);
  }
  round_trips_us_.reserve(kMostTimes);
  sample_ages_us_.reserve(kMostTimes);
  arm_->on_byte = [this](std::uint8_t byte, double us) { hear(byte, us); };
  arm_->on_step = [this](double seconds) { book(seconds, arm_->torques(), arm_->carrying()); };
  arm_->run_to_us(kStartMs * kTickUs);
}

double OurRig::quantum_mm() const {
  // A count of four sums of 10 bits over 340 degrees at some 105 mm; a motor's count over ten.
  return arm_->drive() == firmware::Drive::Stop ? 5.93 / 4092 * 105 : 3.8e-5 * 105;
}

Vec3 OurRig::weight_n() const {
  const auto torques = arm::weight_left(arm_->size(), angles_, arm::kMotorArmWeight);
  return arm::force_at_tip(arm_->size(), angles_, torques);
}

void OurRig::hear(std::uint8_t byte, double us) {
  // The way back is as bad as the way there; a frame is lost by one bit of it.
  if (line_rng_.uniform() < faults.corrupt / 14) byte ^= static_cast<std::uint8_t>(0x10);
  decoder_.push(byte);
  while (decoder_.next()) {
    firmware::Identity identity;
    firmware::Sensors sensors;
    firmware::Motion motion;
    std::array<double, 3> angles{};
    if (decoder_.read_frame(identity)) {
      is_known_ = true;
      status_ = 0;
      answered_us_ = us;
      continue;
    }
    std::uint8_t echo = 0;
    if (decoder_.read_frame(sensors)) {
      status_ = sensors.status;
      echo = sensors.echo;
      for (std::size_t i = 0; i < 3; ++i)
        angles[i] = calibrations_[i].angle_at(sensors.legs[i].counts);
      if (sample_ages_us_.size() < kMostTimes) sample_ages_us_.push_back(4.0 * sensors.age_4us);
    } else if (decoder_.read_frame(motion)) {
      status_ = motion.status;
      echo = motion.echo;
      const firmware::Home home = arm_->home();
      for (std::size_t i = 0; i < 3; ++i) {
        angles[i] =
            (motion.counts[i] - home.zero_counts[i]) * static_cast<double>(firmware::kRadPerCount);
      }
    } else {
      continue;
    }
    answered_us_ = us;
    if ((status_ & firmware::kStatusAfterReset) != 0) is_known_ = false;
    if (round_trips_us_.size() < kMostTimes) round_trips_us_.push_back(us - sent_us_[echo]);
    estimate(angles);
    if (arm_->drive() == firmware::Drive::Motor) {
      const Vec3 force =
          Vec3{motion.force_mn[0] * 1e-3, motion.force_mn[1] * 1e-3, motion.force_mn[2] * 1e-3};
      const bool is_near = wall().offset_mm - dot(wall().normal, tip_) > -2;
      if (!is_near) net_.close();
      share_ = is_near ? net_.share(force - last_besides_, tip_) : 1;
    }
  }
}

void OurRig::estimate(const std::array<double, 3>& angles) {
  const bool is_pot = arm_->drive() == firmware::Drive::Stop;
  for (std::size_t i = 0; i < 3; ++i) {
    if (has_angles_) {
      rates_[i] += ((angles[i] - angles_[i]) / kTickSeconds - rates_[i]) * kRateFilter;
    }
    angles_[i] =
        has_angles_ && is_pot ? angles_[i] + kAngleFilter * (angles[i] - angles_[i]) : angles[i];
  }
  const auto tip = arm::forward(arm_->size(), angles_);
  if (!tip) return;
  if (has_angles_) velocity_ += ((*tip - tip_) / kTickSeconds - velocity_) * kVelocityFilter;
  tip_ = *tip;
  has_angles_ = true;
}

void OurRig::put_on_line(std::vector<std::uint8_t> bytes) {
  if (line_rng_.uniform() < faults.lost) bytes.clear();
  if (!bytes.empty() && line_rng_.uniform() < faults.corrupt) {
    for (std::uint64_t n = 1 + line_rng_.below(3); n > 0; --n) {
      bytes[line_rng_.below(bytes.size())] = static_cast<std::uint8_t>(line_rng_.below(256));
    }
  }
  if (!bytes.empty() && line_rng_.uniform() < faults.doubled) {
    const std::vector<std::uint8_t> once = bytes;
    bytes.insert(bytes.end(), once.begin(), once.end());
  }
  if (!bytes.empty() && line_rng_.uniform() < faults.reordered) {
    late_.push_back(bytes);
    return;
  }
  arm_->send(bytes);
  if (!late_.empty()) {
    arm_->send(late_.front());
    late_.pop_front();
  }
}

template <typename Frame>
void OurRig::send(const Frame& frame) {
  std::vector<std::uint8_t> bytes(firmware::kMaxFrameBytes);
  bytes.resize(firmware::encode_frame(frame, ++sequence_, bytes.data()));
  sent_us_[sequence_] = arm_->now_us();
  put_on_line(std::move(bytes));
}

void OurRig::send_wish() {
  if (arm_->drive() == firmware::Drive::Stop) {
    if (!has_wall() || !has_angles_) {
      send(stops_.free());
    } else {
      send(stops_.at(arm_->size(), wall(), angles_, tip_, velocity_));
    }
    return;
  }
  haptics::HapticWish wish;
  if (has_wall()) {
    wish.plane_count = 1;
    wish.planes[0] = wall();
  }
  if (has_angles_) {
    const Vec3 smooth =
        arm::against_cogging(arm_->size(), arm_->cogging(), angles_, rates_, kAheadS);
    wish.besides_n = weight_n() + besides_n + smooth;
  }
  last_besides_ = wish.besides_n;
  send(haptics::contact_frame(wish, share_, limiter_));
}

void OurRig::tick() {
  if (faults.host_is_silent) return;
  is_running_ = false;
  if (is_known_ && arm_->now_us() - answered_us_ > kAnswerIsOldUs) is_known_ = false;
  if (!is_known_) {
    if (ticks_ % kHelloTicks == 0) send(firmware::Hello{firmware::kProtocolVersion});
    return;
  }
  if ((status_ & firmware::kStatusConfigured) == 0) {
    if (arm_->drive() == firmware::Drive::Stop) {
      send(arm_->leg_config(next_config_++ % 3));
    } else {
      send(arm_->home());
    }
    return;
  }
  is_running_ = true;
  send_wish();
}

void OurRig::run_ms() {
  tick();
  ++ticks_;
  arm_->run_to_us(arm_->now_us() + kTickUs);
}

}  // namespace carpus::device_bench
