// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A script through the whole core, both drives, with frames that are corrupt, late, repeated and
// missing, and the digest of all that it sends and drives: whatever processor runs it must come to
// the same.
#pragma once

#include "firmware/core/motor_arm.hpp"
#include "firmware/core/stop_arm.hpp"

namespace carpus {
namespace firmware {

/// FNV-1a.
class Digest {
 public:
  void add(const uint8_t* bytes, uint8_t count) {
    for (uint8_t i = 0; i < count; ++i) value_ = (value_ ^ bytes[i]) * 16777619U;
  }
  void add(uint32_t word) {
    uint8_t bytes[4];
    write(word, bytes);
    add(bytes, 4);
  }
  void add(float number) {
    union {
      float number;
      uint32_t word;
    } bits = {number};
    add(bits.word);
  }
  uint32_t value() const { return value_; }

 private:
  uint32_t value_ = 2166136261U;
};

/// Numerical Recipes' 32-bit generator; its upper bits.
class ScriptRandom {
 public:
  uint32_t below(uint32_t count) {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 16) % count;
  }

 private:
  uint32_t state_ = 20261;
};

/// Sends a frame as a bad line does: one in fifty is damaged, one in fifty is lost, one in fifty
/// comes twice.
template <typename Arm, typename Frame>
void send_badly(Arm& arm,
                const Frame& frame,
                uint8_t sequence,
                uint32_t now_us,
                ScriptRandom& random) {
  uint8_t bytes[kMaxFrameBytes];
  const uint8_t length = encode_frame(frame, sequence, bytes);
  const uint32_t luck = random.below(50);
  if (luck == 0) return;
  if (luck == 1) bytes[random.below(length)] ^= static_cast<uint8_t>(1U << random.below(8));
  for (uint8_t times = luck == 2 ? 2 : 1; times > 0; --times) {
    for (uint8_t i = 0; i < length; ++i) arm.take(bytes[i], now_us);
  }
}

inline void run_stop_script(Digest& digest, ScriptRandom& random) {
  StopArm arm(7);
  uint8_t sequence = 0;
  uint8_t reply[kMaxDeviceFrameBytes];
  uint16_t counts = 2000;
  for (uint32_t ms = 0; ms < 400; ++ms) {
    const uint32_t now = ms * 1000;
    if (ms < 200 || ms > 240) {  // silent between
      ++sequence;
      if (ms < 10) {
        send_badly(arm, Hello{}, sequence, now, random);
      } else if (ms < 40) {
        LegConfig config;
        config.leg = static_cast<uint8_t>(ms % 3);
        config.zero_counts = 2000;
        config.gain = 15473;
        config.pulse_at_zero_us = 1500;
        config.pulse_per_turn_us = 2000;
        config.gap = 410;
        config.least_pulse_us = 1000;
        config.most_pulse_us = 2000;
        send_badly(arm, config, sequence, now, random);
      } else {
        Stop stop;
        for (uint8_t i = 0; i < 3; ++i) {
          stop.legs[i].angle = static_cast<int16_t>(random.below(600));
          stop.legs[i].side = static_cast<LegStopSide>(random.below(60) == 0 ? 3 : i);
        }
        send_badly(arm, stop, sequence, now, random);
      }
    }
    counts = static_cast<uint16_t>(counts + random.below(9) - 4);
    for (uint8_t leg = 0; leg < 3; ++leg) {
      arm.sample(leg, ms == 300 ? uint16_t{4092} : counts, now);
      arm.step(leg, now);
      if (ms % 20 == 0 && arm.pulse_half_us(leg) != 0) arm.sent(leg);
      digest.add(uint32_t{arm.pulse_half_us(leg)});
    }
    digest.add(reply, arm.reply(reply, now));
  }
}

inline void run_motor_script(Digest& digest, ScriptRandom& random) {
  MotorArm arm(8);
  uint8_t sequence = 0;
  uint8_t reply[kMaxDeviceFrameBytes];
  int32_t counts[3] = {9000, 9000, 9000};
  for (uint32_t step = 0; step < 4000; ++step) {
    const uint32_t now = step * 250;
    const uint32_t ms = step / 4;
    if (step % 4 == 0 && (ms < 600 || ms > 650)) {
      ++sequence;
      if (ms < 5) {
        send_badly(arm, Hello{}, sequence, now, random);
      } else if (ms < 10) {
        Home home;
        for (uint8_t i = 0; i < 3; ++i) {
          home.electrical_zero[i] = static_cast<uint16_t>(9000 * i);
          home.windings[i] = static_cast<uint8_t>(1 + i % 2);
        }
        send_badly(arm, home, sequence, now, random);
      } else {
        Contact contact;
        contact.normals[2] = 16384;
        contact.normals[3] = 8000;
        contact.normals[5] = 12000;
        contact.offsets_um[0] = -150000 + static_cast<int32_t>(random.below(2000));
        contact.offsets_um[1] = -120000;
        contact.stiffness_n_per_m[0] = 2000;
        contact.stiffness_n_per_m[1] = static_cast<uint16_t>(random.below(2) * 1500);
        contact.damping_mns_per_m[0] = 3000;
        contact.friction[0] = 40;
        contact.force_mn[1] = 200;
        contact.limit_mn = 5000;
        contact.vibration_hz = 120;
        contact.vibration_mn = static_cast<uint16_t>(100 * (ms / 300));
        send_badly(arm, contact, sequence, now, random);
      }
    }
    for (uint8_t i = 0; i < 3; ++i)
      counts[i] += static_cast<int32_t>(random.below(21)) - 10 + (ms < 400 ? 1 : -1);
    float torques[3];
    arm.step(counts, now, torques);
    arm.sample_roll(static_cast<uint16_t>(ms & 4095U));
    for (uint8_t i = 0; i < 3; ++i) {
      digest.add(torques[i]);
      for (const float volts : arm.volts(i).volts) digest.add(volts);
    }
    digest.add(reply, arm.reply(reply, now));
  }
}

/// Rotors that follow their fields at once.
inline void run_alignment_script(Digest& digest, ScriptRandom& random) {
  MotorArm arm(9);
  uint8_t sequence = 0;
  uint8_t reply[kMaxDeviceFrameBytes];
  int32_t counts[3] = {100, 200, 300};
  for (uint32_t step = 0; step < 40000; ++step) {
    const uint32_t now = step * 250;
    if (step % 4 == 0) {
      ++sequence;
      if (step < 20) {
        send_badly(arm, Hello{}, sequence, now, random);
      } else {
        send_badly(arm, Align{}, sequence, now, random);
      }
    }
    float torques[3];
    arm.step(counts, now, torques);
    for (uint8_t i = 0; i < 3; ++i) {
      const WindingVolts volts = arm.volts(i);
      for (const float one : volts.volts) digest.add(one);
      counts[i] +=
          static_cast<int32_t>(volts.volts[1] > 0.0F) - static_cast<int32_t>(volts.volts[2] > 0.0F);
    }
    digest.add(reply, arm.reply(reply, now));
  }
}

inline uint32_t digest_of_core_script() {
  Digest digest;
  ScriptRandom random;
  run_stop_script(digest, random);
  run_motor_script(digest, random);
  run_alignment_script(digest, random);
  return digest.value();
}

}  // namespace firmware
}  // namespace carpus
