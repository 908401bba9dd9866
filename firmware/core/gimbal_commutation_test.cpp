// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/gimbal_commutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/core/motor_alignment.hpp"

namespace carpus::firmware {
namespace {

constexpr double kTurn = 6.283185307179586;

/// Of the field across the rotor, in the direction in which counts rise [V].
double across(const WindingVolts& volts, double rotor, double sign) {
  const double alpha = static_cast<double>(volts.volts[0]);
  const double beta = static_cast<double>(volts.volts[1] - volts.volts[2]) / std::sqrt(3.0);
  return sign * (beta * std::cos(rotor) - alpha * std::sin(rotor));
}

TEST(Commutation, GivesEveryRotorTheTorqueThatIsAskedWhicheverWayItIsWound) {
  const GimbalWindings motor;
  for (const Windings windings : {Windings::Along, Windings::Against}) {
    const double sign = windings == Windings::Along ? 1 : -1;
    for (int zero = 0; zero < 65536; zero += 4096) {
      for (int counts = -40000; counts < 40000; counts += 1237) {
        WindingsOf of;
        of.electrical_zero = static_cast<std::uint16_t>(zero);
        of.windings = windings;
        const double rotor = kTurn / 65536 * (zero + sign * counts * kElectricalPerCount);
        const WindingVolts volts = commutate(motor, of, counts, 280.0F, 0.0F);
        const double amps = across(volts, rotor, sign) / 2.8;
        ASSERT_NEAR(380 * amps, 280, 0.5) << zero << ' ' << counts;
        ASSERT_NEAR(static_cast<double>(volts.volts[0] + volts.volts[1] + volts.volts[2]), 0, 1e-5);
      }
    }
  }
}

TEST(Commutation, AddsWhatTheRotorInducesAndKeepsToItsSupply) {
  const GimbalWindings motor;
  WindingsOf of;
  of.windings = Windings::Along;
  // At 8 rad/s of a leg, 0.5 m/s at the tip, its motor induces 3 V; nothing is asked of it. It has
  // turned on by the time that its voltages stand.
  const double on = 8 * 10.0 * kPolePairs * static_cast<double>(kCommutationDelayS);
  const WindingVolts turning = commutate(motor, of, 0, 0.0F, 8.0F);
  EXPECT_NEAR(across(turning, on, 1), 0.98 * 8 * 0.38, 0.01) << "a fiftieth less";
  const WindingVolts most = commutate(motor, of, 0, 940.0F, 8.0F);
  EXPECT_NEAR(across(most, on, 1), 6.9, 0.01);
  for (const float torque : {std::nanf(""), INFINITY}) {
    const WindingVolts none = commutate(motor, of, 0, torque, 0.0F);
    for (const float volts : none.volts) EXPECT_EQ(volts, 0.0F);
  }
  of.windings = Windings::Unknown;
  for (const float volts : commutate(motor, of, 0, 280.0F, 0.0F).volts) EXPECT_EQ(volts, 0.0F);
}

/// Three rotors that rub: they follow their fields until so many counts beside them.
struct Rotors {
  MotorAlignment alignment;
  int zero[3] = {1000, 30000, 65000};
  double sign[3] = {1, -1, 1};
  double at[3] = {5000, -300, 120};
  double rubs = 60;
  int blocked = -1;

  /// Of an electrical turn, between a half to either side.
  static double wrapped(double turns) { return turns - std::round(turns); }
  void run() {
    alignment.start();
    for (int step = 0; step < 40000 && alignment.is_running(); ++step) {
      std::int32_t counts[3];
      for (int i = 0; i < 3; ++i) counts[i] = static_cast<std::int32_t>(std::floor(at[i]));
      const int motor = alignment.step(counts);
      const WindingVolts volts = alignment.volts();
      const double size =
          std::hypot(static_cast<double>(volts.volts[0]),
                     static_cast<double>(volts.volts[1] - volts.volts[2]) / std::sqrt(3.0));
      if (size < 0.5 || motor == blocked) continue;
      const double field =
          std::atan2(static_cast<double>(volts.volts[1] - volts.volts[2]) / std::sqrt(3.0),
                     static_cast<double>(volts.volts[0])) /
          kTurn;
      const double rotor = (zero[motor] + sign[motor] * at[motor] * kElectricalPerCount) / 65536;
      // In counts, towards the field.
      const double ahead = sign[motor] * wrapped(field - rotor) * 65536 / kElectricalPerCount;
      if (std::abs(ahead) > rubs)
        at[motor] += std::clamp(ahead - std::copysign(rubs, ahead), -40.0, 40.0);
    }
  }
};

TEST(MotorAlignment, FindsHowWindingsStandThoughRotorsRub) {
  for (const double rubs : {0.0, 30.0, 60.0}) {
    Rotors rotors;
    rotors.rubs = rubs;
    rotors.run();
    ASSERT_EQ(rotors.alignment.progress(), Progress::Found) << rubs;
    for (std::uint8_t i = 0; i < 3; ++i) {
      const WindingsOf& found = rotors.alignment.found(i);
      EXPECT_EQ(found.windings, rotors.sign[i] > 0 ? Windings::Along : Windings::Against);
      const double beside = Rotors::wrapped((found.electrical_zero - rotors.zero[i]) / 65536.0);
      EXPECT_LT(std::abs(beside) * 360, 2) << int{i} << ", degrees, rubs " << rubs;
    }
  }
}

TEST(MotorAlignment, RefusesAMotorThatDoesNotFollow) {
  Rotors rotors;
  rotors.blocked = 1;
  rotors.run();
  EXPECT_EQ(rotors.alignment.progress(), Progress::Refused);
  for (std::uint8_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rotors.alignment.found(i).windings, Windings::Unknown);
  }
}

}  // namespace
}  // namespace carpus::firmware
