// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "firmware/core/motor_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/rng.hpp"
#include "firmware/core/core_script.hpp"

namespace carpus::firmware {
namespace {

using Vec = Vector<double>;

TEST(Delta, TheTipIsARodsLengthFromEachElbowAndBelowThem) {
  const DeltaSize<double> size;
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const double angles[3] = {rng.uniform(-0.6, 1.2), rng.uniform(-0.6, 1.2),
                              rng.uniform(-0.6, 1.2)};
    const DeltaState<double> state = delta_forward(size, angles);
    if (!state.is_valid) continue;
    for (std::uint8_t leg = 0; leg < 3; ++leg) {
      Vec elbow;
      Vec change;
      delta_elbow(size, leg, angles[leg], elbow, change);
      EXPECT_NEAR(length(state.tip - elbow), size.rod, 1e-9);
      EXPECT_LT(state.tip.z, elbow.z);
    }
  }
}

TEST(Delta, VelocitiesAreDifferencesOfPlacesAndForcesDoTheWorkOfTorques) {
  const DeltaSize<double> size;
  Rng rng(2);
  for (int i = 0; i < 500; ++i) {
    double angles[3];
    double rates[3];
    for (int k = 0; k < 3; ++k) {
      angles[k] = rng.uniform(-0.3, 1.0);
      rates[k] = rng.uniform(-1, 1);
    }
    const DeltaState<double> state = delta_forward(size, angles);
    if (!state.is_valid) continue;
    constexpr double kStep = 1e-5;
    double later[3];
    double before[3];
    for (int k = 0; k < 3; ++k) {
      later[k] = angles[k] + rates[k] * kStep;
      before[k] = angles[k] - rates[k] * kStep;
    }
    const Vec moved =
        (delta_forward(size, later).tip - delta_forward(size, before).tip) * (0.5 / kStep);
    const Vec velocity = delta_velocity(state, rates);
    EXPECT_NEAR(length(moved - velocity), 0, 1e-6 * (1 + length(velocity)));
    const Vec force(rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-5, 5));
    double torques[3];
    delta_torques(state, force, torques);
    double power = 0;
    for (int k = 0; k < 3; ++k) power += torques[k] * rates[k];
    EXPECT_NEAR(power, dot(force, velocity), 1e-9 * (1 + std::abs(power)));
  }
}

TEST(SinCos, IsTheLibrarysToLastDigitsOfEitherKind) {
  for (double x = -10; x < 10; x += 0.00137) {
    const SinCos<double> d = sin_cos(x);
    EXPECT_NEAR(d.sin, std::sin(x), 1e-14 * 40);
    EXPECT_NEAR(d.cos, std::cos(x), 1e-14 * 40);
    const SinCos<float> f = sin_cos(static_cast<float>(x));
    EXPECT_NEAR(static_cast<double>(f.sin), std::sin(x), 2e-6);
    EXPECT_NEAR(static_cast<double>(f.cos), std::cos(x), 2e-6);
  }
}

/// An arm at rest at the middle of its workspace, and its host.
struct Rig {
  MotorArm arm;
  std::uint32_t now_us = 0;
  std::uint8_t sequence = 0;
  std::int32_t counts[3] = {0, 0, 0};
  float torques[3] = {};
  Contact contact;
  Motion last;
  bool host_is_silent = false;
  std::int32_t drift = 0;  ///< of the counts in a step

  explicit Rig(const MotorLimits& limits = MotorLimits()) : arm(3, limits) {
    contact.normals[2] = 16384;
    contact.limit_mn = 8000;
    send(Hello{kProtocolVersion});
    Home home;
    for (std::uint8_t& windings : home.windings) windings = 1;
    send(home);
  }
  template <typename Frame>
  void send(const Frame& frame) {
    std::uint8_t bytes[kMaxFrameBytes];
    const int length = encode_frame(frame, ++sequence, bytes);
    for (int i = 0; i < length; ++i) arm.take(bytes[i], now_us);
    std::uint8_t reply[kMaxDeviceFrameBytes];
    const int answer = arm.reply(reply, now_us);
    HostDecoder decoder;
    for (int i = 0; i < answer; ++i) decoder.push(reply[i]);
    if (decoder.next()) (void)decoder.read_frame(last);
  }
  void run_ms(int ms) {
    for (int i = 0; i < 4 * ms; ++i) {
      for (std::int32_t& c : counts) c += drift;
      if (i % 4 == 0 && !host_is_silent) send(contact);
      now_us += 250;
      arm.step(counts, now_us, torques);
    }
  }
  /// A plane so far above the tip [mm].
  void wall(double depth_mm, int stiffness) {
    contact.offsets_um[0] =
        static_cast<std::int32_t>((static_cast<double>(tip_z()) + depth_mm) * 1000);
    contact.stiffness_n_per_m[0] = static_cast<std::uint16_t>(stiffness);
  }
  [[nodiscard]] float tip_z() const { return arm.state().tip.z; }
};

TEST(MotorArm, APlaneIsASpringOutOfTheBone) {
  // A hand presses: counts rise, the tip goes down.
  Rig pressed;
  pressed.run_ms(200);
  pressed.wall(0.0, 2000);
  for (int i = 0; i < 200; ++i) {
    for (std::int32_t& c : pressed.counts) c += 2;
    pressed.run_ms(1);
  }
  const double depth =
      pressed.contact.offsets_um[0] / 1000.0 - static_cast<double>(pressed.tip_z());
  ASSERT_GT(depth, 0.5);
  EXPECT_NEAR(static_cast<double>(pressed.arm.force().z), 2.0 * depth, 0.02);
  EXPECT_NEAR(pressed.last.force_mn[2] * 0.001, 2.0 * depth, 0.05);
  EXPECT_NEAR(static_cast<double>(pressed.torques[0]), static_cast<double>(pressed.torques[1]),
              0.5);
}

TEST(PlaneRenderer, CarriesTheWeightWhereTheAccountIsEmpty) {
  PlaneRenderer renderer(1.0F / 4000);
  Contact contact;
  contact.normals[2] = 16384;
  contact.stiffness_n_per_m[0] = 4000;
  contact.limit_mn = 8000;
  contact.force_mn[2] = 900;
  renderer.take(contact);
  Rng rng(8);
  for (int i = 0; i < 20000; ++i) {
    const Vector<float> tip(0, 0, static_cast<float>(rng.uniform(-0.2, 0.1)));
    EXPECT_GE(renderer.step(tip, {}).z, 0.899F);
  }
  EXPECT_GT(renderer.scaled(), 1000U);
}

TEST(MotorArm, NeverExceedsTheLimitThatTheHostSetsNorItsTorque) {
  Rig rig;
  rig.run_ms(200);
  rig.contact.force_mn[0] = 8000;
  rig.contact.force_mn[1] = -8000;
  rig.contact.force_mn[2] = 8000;
  rig.contact.limit_mn = 3000;
  rig.run_ms(200);
  EXPECT_NEAR(static_cast<double>(length(rig.arm.force())), 3.0, 1e-3);
  rig.contact.limit_mn = 8000;
  rig.run_ms(100);
  for (const float torque : rig.torques) EXPECT_LE(std::abs(torque), MotorLimits().peak_torque);
}

TEST(MotorArm, ForceFallsToNothingWithin25MsOfSilence) {
  Rig rig;
  rig.contact.force_mn[2] = 4000;
  rig.run_ms(300);
  ASSERT_NEAR(static_cast<double>(rig.arm.force().z), 4.0, 1e-3);
  rig.host_is_silent = true;
  rig.run_ms(14);
  EXPECT_NEAR(static_cast<double>(rig.arm.force().z), 4.0, 1e-3) << "it goes on alone for a while";
  rig.run_ms(6);
  EXPECT_LT(rig.arm.force().z, 3.0F);
  rig.run_ms(6);
  EXPECT_EQ(rig.arm.force().z, 0.0F);
  for (const float torque : rig.torques) EXPECT_EQ(torque, 0.0F);
  rig.run_ms(24);
  rig.host_is_silent = false;
  rig.run_ms(100);
  EXPECT_NEAR(static_cast<double>(rig.arm.force().z), 4.0, 1e-3);
}

TEST(MotorArm, AnEncoderThatJumpsOrAnArmThatRunsAwayGetsNoTorque) {
  Rig rig;
  rig.contact.force_mn[2] = 4000;
  rig.run_ms(300);
  rig.counts[0] += 3000;
  rig.run_ms(1);
  EXPECT_EQ(rig.arm.force().z, 0.0F);
  EXPECT_TRUE(rig.last.status & kStatusSensorFault || rig.arm.status() & kStatusSensorFault);
  rig.run_ms(200);
  EXPECT_GT(rig.arm.force().z, 3.9F);
  rig.drift = -200;  // 2.4 m/s
  rig.run_ms(10);
  EXPECT_TRUE(rig.arm.state().is_valid);
  EXPECT_TRUE(rig.arm.status() & kStatusTooFast);
  EXPECT_EQ(rig.arm.force().z, 0.0F);
}

TEST(MotorArm, WarmWindingsGetLessAndHotOnesNothing) {
  MotorLimits limits;
  limits.time_constant_s = 5.0F;  // the motor's own would take minutes
  Rig rig(limits);
  rig.contact.force_mn[0] = 8000;
  rig.run_ms(300);
  const float at_first = std::abs(rig.torques[0]);
  for (int i = 0; i < 25; ++i) rig.run_ms(1000);
  EXPECT_LT(std::abs(rig.torques[0]), 0.999F * at_first);
  EXPECT_LT(rig.last.hottest_c, 96);
  EXPECT_GT(rig.last.hottest_c, 79);
  EXPECT_TRUE(rig.last.status & kStatusHot);
}

TEST(MotorArm, APlaneThatAppearsAroundTheTipOrRisesThrowsNobodyOut) {
  Rig rig;
  rig.run_ms(200);
  rig.wall(8.0, 3000);  // 24 N if believed at once
  rig.run_ms(1);
  EXPECT_LT(std::abs(rig.arm.force().z), 0.3F);
  rig.run_ms(20);
  EXPECT_LT(std::abs(rig.arm.force().z), 3.3F) << "50 mm/s";
  rig.run_ms(500);
  // What a still hand may be held with: the account's first store over the way of a start.
  constexpr float kStartMm = kMostSurpriseMmPerS2 / kMotorStepHz / kMotorStepHz;
  EXPECT_LE(std::abs(rig.arm.force().z), kFirstStoreNMm / kStartMm * 1.001F);
}

TEST(PlaneRenderer, GivesBackNoMoreThanWasPutInHoweverPlanesJump) {
  Rng rng(4);
  for (int round = 0; round < 40; ++round) {
    PlaneRenderer renderer(1.0F / kMotorStepHz);
    Contact contact;
    contact.limit_mn = 8000;
    Vector<float> place;
    Vector<float> move;
    Vector<float> muscle;
    double work = 0;
    for (int step = 0; step < 20000; ++step) {
      if (step % 40 == 0) {
        contact.normals[2] = 16384;
        contact.stiffness_n_per_m[0] = 3000;
        contact.friction[0] = 60;
        contact.offsets_um[0] = static_cast<std::int32_t>(rng.below(3000)) - 1500;
        renderer.take(contact);
      }
      if (step % 160 == 0) {
        muscle = Vector<float>(static_cast<float>(rng.uniform(-6, 6)),
                               static_cast<float>(rng.uniform(-6, 6)),
                               static_cast<float>(rng.uniform(-6, 6))) -
                 place * 0.5F;
      }
      const Vector<float> force = renderer.step(place, move * float{kMotorStepHz});
      // A hand of 0.3 kg, 1 N is 1000 kg mm/s2.
      Vector<float> change = (muscle + force) * (1000.0F / 0.3F / kMotorStepHz / kMotorStepHz);
      const float most = 0.99F * kMostSurpriseMmPerS2 / kMotorStepHz / kMotorStepHz;
      if (length(change) > most) change = change * (most / length(change));
      move = (move + change) * 0.999F;
      place = place + move;
      work += static_cast<double>(dot(force, move));
      ASSERT_LE(work, static_cast<double>(kFirstStoreNMm) + 1e-3 + 1e-4 * step)
          << round << " " << step;
    }
  }
}

TEST(PlaneRenderer, APlaneThatTurnsAboutTheTipKeepsPressingIt) {
  // The tip works 134 mm below the origin: five degrees are eleven millimetres of a plane's offset.
  PlaneRenderer renderer(1.0F / kMotorStepHz);
  const Vector<float> tip(1.0F, 0.5F, -134.0F);
  const auto told = [&](double degrees) {
    const double turn = degrees * 3.14159265358979 / 180;
    const double n[3] = {0, std::sin(turn), std::cos(turn)};
    const double depth = 0.4;
    Contact contact;
    contact.limit_mn = 8000;
    contact.stiffness_n_per_m[0] = 2000;
    for (int k = 0; k < 3; ++k) {
      contact.normals[k] = static_cast<std::int16_t>(std::lround(n[k] * 16384));
    }
    contact.offsets_um[0] = static_cast<std::int32_t>(
        std::lround(1000 * (n[0] * 1.0 + n[1] * 0.5 - n[2] * 134.0 + depth)));
    return contact;
  };
  // Met from above: the account then has something to give.
  renderer.take(told(0));
  Vector<float> place = tip + Vector<float>(0.0F, 0.0F, 1.0F);
  Vector<float> force;
  for (; place.z > tip.z; place.z -= 0.01F) force = renderer.step(place, Vector<float>());
  ASSERT_NEAR(force.z, 0.8F, 0.05F);
  for (const double degrees : {5.0, -4.0, 8.0, 0.0}) {
    renderer.take(told(degrees));
    force = renderer.step(tip, Vector<float>());
    EXPECT_NEAR(length(force), 0.8F, 0.1F) << degrees;
  }
}

TEST(CoreScript, IsTheSameOnEveryProcessor) {
  // A changed digest is a changed behaviour of the firmware: look at it, then write it here.
  EXPECT_EQ(digest_of_core_script(), 0xf6cebad4U);
}

}  // namespace
}  // namespace carpus::firmware
