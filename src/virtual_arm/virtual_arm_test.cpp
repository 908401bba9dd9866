// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "virtual_arm/virtual_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "firmware/core/frame_decoder.hpp"
#include "firmware/core/frame_encoder.hpp"
#include "firmware/core/tool_roll.hpp"

namespace carpus::virtual_arm {
namespace {

/// A host that does nothing but keep the line alive.
struct Host {
  explicit Host(std::unique_ptr<VirtualArm> which) : arm(std::move(which)) {
    arm->on_byte = [this](std::uint8_t byte, double) {
      decoder.push(byte);
      while (decoder.next()) {
        ++answers;
        (void)decoder.read_frame(sensors);
        (void)decoder.read_frame(motion);
        (void)decoder.read_frame(alignment);
      }
    };
  }
  template <typename Frame>
  void send(const Frame& frame) {
    std::uint8_t bytes[firmware::kMaxFrameBytes];
    const int length = firmware::encode_frame(frame, ++sequence, bytes);
    arm->send({bytes, static_cast<std::size_t>(length)});
  }
  void run_ms(double ms) { arm->run_to_us(arm->now_us() + 1000 * ms); }
  void greet() {
    run_ms(60);
    send(firmware::Hello{firmware::kProtocolVersion});
    run_ms(2);
    for (int leg = 0; leg < 3 && arm->drive() == firmware::Drive::Stop; ++leg) {
      send(arm->leg_config(leg));
      run_ms(2);
    }
    if (arm->drive() == firmware::Drive::Motor) {
      send(arm->home());
      run_ms(2);
    }
  }
  std::unique_ptr<VirtualArm> arm;
  firmware::HostDecoder decoder;
  firmware::Sensors sensors;
  firmware::Motion motion;
  firmware::Alignment alignment;
  int answers = 0;
  std::uint8_t sequence = 0;
};

TEST(VirtualArm, DriveASaysWhereItIsAndFollowsTheHandWithItsSlots) {
  VirtualArmOptions options;
  options.seed = 3;
  Host host(make_virtual_stop_arm(options));
  host.greet();
  double worst = 0;
  const Vec3 start = host.arm->plant().tip();
  for (int ms = 0; ms < 1500; ++ms) {
    const double t = 0.001 * ms;
    host.arm->plant().set_intent({start + Vec3{20 * std::sin(3 * t), 0, 10 * std::sin(5 * t)},
                                  {60 * std::cos(3 * t), 0, 50 * std::cos(5 * t)}});
    host.send(firmware::Stop{});
    host.run_ms(1);
    if (ms < 300) continue;
    for (int leg = 0; leg < 3; ++leg) {
      const auto i = static_cast<std::size_t>(leg);
      const double angle = host.arm->leg_calibration(leg).angle_at(host.sensors.legs[i].counts);
      worst = std::max(worst, std::abs(angle - host.arm->plant().angles()[i]));
      EXPECT_EQ(host.arm->torques()[i], 0) << "no slot's edge is met in free space, " << ms;
    }
  }
  EXPECT_TRUE(host.arm->is_driven());
  EXPECT_GT(host.answers, 1400);
  EXPECT_LT(worst, 0.02);
  EXPECT_TRUE(host.arm->plant().is_sound());
}

TEST(VirtualArm, DriveBRendersAPlaneOnItsOwn) {
  Host host(make_virtual_motor_arm({}));
  host.greet();
  firmware::Contact contact;
  contact.normals[2] = 16384;
  contact.stiffness_n_per_m[0] = 2000;
  contact.damping_mns_per_m[0] = 2000;
  contact.offsets_um[0] = -131'000;
  contact.limit_mn = 8000;
  const Vec3 start = host.arm->plant().tip();
  for (int ms = 0; ms < 800; ++ms) {
    host.arm->plant().set_intent({start - Vec3{0, 0, 0.02 * ms}, {0, 0, -20}});
    host.send(contact);
    host.run_ms(1);
  }
  const ArmPlant& plant = host.arm->plant();
  const double weight_n = force_of(plant.linkage_state(), plant.weight_to_hold()).z;
  EXPECT_NEAR(plant.felt_n().z, host.motion.force_mn[2] * 0.001 - weight_n, 0.4)
      << "nobody asked that it be carried";
  EXPECT_GT(host.motion.force_mn[2], 1000);
  EXPECT_TRUE(host.arm->plant().is_sound());
}

TEST(VirtualArm, DriveBFindsHowItsWindingsStandInAHandThatGoesAlong) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    VirtualArmOptions options;
    options.seed = seed;
    options.hand = kHandModels[0];
    Host host(make_virtual_motor_arm(options));
    host.run_ms(60);
    host.send(firmware::Hello{firmware::kProtocolVersion});
    const Vec3 start = host.arm->plant().tip();
    // Two fingers bear the arm's weight before its motors can.
    const double weight_n =
        force_of(host.arm->plant().linkage_state(), host.arm->plant().weight_to_hold()).z;
    host.arm->plant().set_intent(
        {start + Vec3{0, 0, weight_n / options.hand.stiffness_n_per_mm}, {}});
    double farthest = 0;
    double most_n = 0;
    int ms = 0;
    for (; ms < 10'000; ++ms) {
      host.send(firmware::Align{});
      host.run_ms(1);
      farthest = std::max(farthest, distance(host.arm->plant().tip(), start));
      most_n = std::max(most_n, length(host.arm->plant().felt_n()));
      if (host.alignment.progress == static_cast<std::uint8_t>(firmware::Progress::Found)) break;
    }
    ASSERT_LT(ms, 8000) << "found, seed " << seed;
    EXPECT_LT(farthest, 12);
    EXPECT_LT(most_n, 5);
    const firmware::Home home = host.arm->home();
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(host.alignment.windings_found[i], home.windings[i]);
      const auto beside = static_cast<std::int16_t>(
          static_cast<std::uint16_t>(host.alignment.electrical_zero[i] - home.electrical_zero[i]));
      EXPECT_LT(std::abs(beside) * 360.0 / 65536, 15) << "electrical degrees, seed " << seed;
    }
    // Nobody asks on: its motors are off.
    host.run_ms(27);
    EXPECT_FALSE(host.arm->is_driven());
  }
}

TEST(VirtualArm, BothDrivesTellTheToolsRoll) {
  for (const bool is_motor : {false, true}) {
    Host host(is_motor ? make_virtual_motor_arm({}) : make_virtual_stop_arm({}));
    host.greet();
    for (const double deg : {0.0, 90.0, 200.0, 359.0}) {
      host.arm->tool_roll_rad = deg * 3.14159265358979 / 180;
      for (int ms = 0; ms < 10; ++ms) {
        if (is_motor) {
          host.send(firmware::Contact{});
        } else {
          host.send(firmware::Stop{});
        }
        host.run_ms(1);
      }
      const int roll = is_motor ? host.motion.roll : firmware::roll_of(host.sensors.legs);
      EXPECT_NEAR(roll * 360.0 / firmware::kRollsOfTurn, deg, 0.4) << is_motor;
    }
  }
}

TEST(VirtualArm, IsTheSameInEveryRun) {
  for (const bool is_motor : {false, true}) {
    const auto run = [is_motor] {
      Host host(is_motor ? make_virtual_motor_arm({}) : make_virtual_stop_arm({}));
      host.greet();
      host.arm->plant().set_intent({{5, 3, -125}, {}});
      for (int ms = 0; ms < 100; ++ms) {
        host.send(firmware::Release{});
        host.run_ms(1);
      }
      return host.arm->plant().tip();
    };
    EXPECT_EQ(run(), run());
  }
}

TEST(ArmPlant, LosesNoEnergyFromNowhereAndComesToRest) {
  const arm::DeltaArm size;
  const DeltaLinkage linkage(size, arm::kStopArmWeight);
  ArmBody body = body_of(arm::kStopArmWeight);
  body.balanced_share = 1;
  ArmPlant plant(linkage, body, *arm::inverse(size, {0, 0, -130}));
  plant.set_hand(kHandModels[2]);
  plant.set_intent({{15, -5, -120}, {}});
  for (int i = 0; i < 40 * 2000; ++i) plant.step(25e-6, {});
  EXPECT_TRUE(plant.is_sound());
  EXPECT_LT(length(plant.tip_velocity()), 0.01);
  // Friction holds it a little short: 0.1 to 0.2 N over 0.5 N/mm.
  EXPECT_LT(length(plant.tip() - Vec3{15, -5, -120}), 0.5);
}

TEST(SerialLinkage, ItsInverseUndoesIt) {
  const SerialLinkage linkage;
  JointValues angles{};
  ASSERT_TRUE(linkage.inverse({140, 20, -30}, angles));
  const LinkageState state = linkage.at(angles);
  EXPECT_NEAR(length(state.tip - Vec3{140, 20, -30}), 0, 1e-9);
  for (std::size_t i = 0; i < 3; ++i) {
    JointValues moved = angles;
    moved[i] += 1e-6;
    EXPECT_NEAR(length((linkage.at(moved).tip - state.tip) / 1e-6 - state.columns[i]), 0, 1e-3);
  }
}

}  // namespace
}  // namespace carpus::virtual_arm
