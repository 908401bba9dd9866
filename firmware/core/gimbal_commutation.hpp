// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// From the torque that a leg of drive B is to get to the voltages of its motor's three windings. A
// gimbal motor's driver measures no current, so a current is made by a voltage across the windings'
// resistance, and what the turning motor itself induces is added.
//
//   i = torque / (ratio k),  U = R i + k w,  field a quarter turn ahead of the rotor
//
// Electrical angles are sixteen bits of a turn: they wrap as they must.
#pragma once

#include "firmware/core/real.hpp"
#include "firmware/core/wire.hpp"

namespace carpus {
namespace firmware {

/// The 2804 class: 14 poles, 2.8 ohm, 38 mN m/A; behind a capstan of 10:1.
struct GimbalWindings {
  float torque_per_amp = 380.0F;  ///< at the joint [N mm/A]
  float ohm = 2.8F;
  /// Added for what the motor induces, of the joint's rate: a fiftieth less than 0.038 V s for
  /// each of ten turns. Too much would push a hand on; what is missing is felt as a little oil [V
  /// s/rad].
  float volt_seconds = 0.3724F;
  /// Of a supply of 12 V, three windings by sine: its root of a third [V].
  float most_volts = 6.9F;
};

constexpr uint8_t kPolePairs = 7;
/// Sixteen bits of an electrical turn, for a count of an encoder of 14 bits.
constexpr uint16_t kElectricalPerCount = 4 * kPolePairs;
/// From a sample of the encoders to the middle of the time in which its voltages stand [s].
constexpr float kCommutationDelayS = 0.0002F;

/// Of the three windings, against their star [V].
struct WindingVolts {
  float volts[3] = {0.0F, 0.0F, 0.0F};
};

/// A field of so many volts at an electrical angle.
inline WindingVolts field_volts(float volts, uint16_t electrical) {
  const SinCos<float> at = sin_cos(static_cast<float>(electrical) * (6.28318531F / 65536.0F));
  constexpr float kHalfRoot3 = 0.866025404F;
  WindingVolts out;
  out.volts[0] = volts * at.cos;
  out.volts[1] = volts * (kHalfRoot3 * at.sin - 0.5F * at.cos);
  out.volts[2] = volts * (-kHalfRoot3 * at.sin - 0.5F * at.cos);
  return out;
}

/// How one motor's windings stand to its encoder.
struct WindingsOf {
  uint16_t electrical_zero = 0;
  Windings windings = Windings::Unknown;

  /// Where the rotor stands. @param counts  of the encoder, turns and all.
  uint16_t electrical_at(int32_t counts) const {
    const uint16_t turned =
        static_cast<uint16_t>(static_cast<uint32_t>(counts) * kElectricalPerCount);
    return static_cast<uint16_t>(windings == Windings::Against ? electrical_zero - turned
                                                               : electrical_zero + turned);
  }
};

/// @param torque  at the joint [N mm] @param rate  of the joint [rad/s].
inline WindingVolts commutate(const GimbalWindings& motor,
                              const WindingsOf& of,
                              int32_t counts,
                              float torque,
                              float rate) {
  if (of.windings == Windings::Unknown || !(absolute(torque) < 1e9F) || !(absolute(rate) < 1e6F))
    return WindingVolts();
  const float sign = of.windings == Windings::Against ? -1.0F : 1.0F;
  const float volts = clamped(torque / motor.torque_per_amp * motor.ohm + rate * motor.volt_seconds,
                              -motor.most_volts, motor.most_volts);
  // Ten turns of the motor to one of the joint.
  constexpr float kElectricalPerRad = 65536.0F * kPolePairs * 10.0F / 6.28318531F;
  const float ahead = clamped(rate * (kCommutationDelayS * kElectricalPerRad), -8192.0F, 8192.0F);
  constexpr float kQuarter = 16384.0F;
  const int32_t lead = static_cast<int32_t>(sign * (kQuarter + ahead));
  return field_volts(volts, static_cast<uint16_t>(of.electrical_at(counts) + lead));
}

}  // namespace firmware
}  // namespace carpus
