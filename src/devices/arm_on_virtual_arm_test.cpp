// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver of our arm against the whole virtual arm: firmware, motors, mechanics, a hand. Virtual
// time.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "arm/delta_arm.hpp"
#include "core/units.hpp"
#include "devices/arm_calibrator.hpp"
#include "devices/arm_device.hpp"
#include "devices/fake_link_test_support.hpp"
#include "devices/guided_hand.hpp"
#include "devices/virtual_unit.hpp"

namespace carpus::devices {
namespace {

class Desk {
 public:
  explicit Desk(firmware::Drive drive, bool is_calibrated = true)
      : unit(drive, 3), line(std::make_shared<FakeLine>()) {
    if (is_calibrated) store(unit.calibration(), folder.path());
    unit.arm().on_byte = [this](std::uint8_t byte, double) { line->to_host.push_back(byte); };
    unit.arm().plant().set_intent({unit.arm().size().centre, {}});
    device = std::make_unique<ArmDevice>(fake_opener(line), folder.path());
    device->open();
    for (const std::string& problem : device->problems()) ADD_FAILURE() << problem;
  }
  void run_ms(int ms, const DeviceCommand& wish = {}) {
    for (int i = 0; i < ms; ++i) {
      if (follows) follows();
      unit.arm().run_to_us(unit.arm().now_us() + 1000);
      const auto now = static_cast<Nanoseconds>(1e9 + unit.arm().now_us() * 1000);
      device->poll(now, state);
      device->turn_servos(pulse_us);
      device->command(now, wish);
      if (keeps_raw) raw.push_back(state.raw_counts);
      unit.arm().send(line->to_device);
      line->to_device.clear();
    }
  }
  [[nodiscard]] Vec3 truly() { return unit.arm().plant().tip() - unit.arm().size().centre; }

  TemporaryFolder folder;
  VirtualUnit unit;
  std::shared_ptr<FakeLine> line;
  std::unique_ptr<ArmDevice> device;
  /// The calibrator's step, as terminal and page do it.
  std::optional<std::string> measure(ArmCalibrator& calibrator,
                                     const std::function<void(int)>& move = {}) {
    pulse_us = calibrator.pulse_us();
    run_ms(calibrator.settle_ms());
    raw.clear();
    keeps_raw = true;
    for (std::size_t ms = 0; ms < calibrator.sample_count(); ++ms) {
      if (move) move(static_cast<int>(ms));
      run_ms(1);
      if (calibrator.is_enough(raw.size(), state.windings)) break;
    }
    keeps_raw = false;
    return calibrator.take(raw, state.windings);
  }
  /// Stored, and read by a device that is opened anew.
  ArmCalibration finish(ArmCalibrator& calibrator) {
    pulse_us = 0;
    const auto made = calibrator.finish("now");
    EXPECT_TRUE(made.has_value()) << made.error();
    if (!made) return {};
    store(*made, folder.path());
    device->open();
    return *made;
  }
  double free_space_n() {
    double sum = 0;
    constexpr int kMs = 2000;
    for (int ms = 0; ms < kMs; ++ms) {
      const double turn = 3.5e-3 * ms;
      const Vec3 place{20 * std::sin(turn), 20 * (std::cos(turn) - 1), 14 * std::sin(0.7 * turn)};
      const Vec3 velocity{70 * std::cos(turn), -70 * std::sin(turn), 34.3 * std::cos(0.7 * turn)};
      unit.arm().plant().set_intent({unit.arm().size().centre + place, velocity});
      run_ms(1);
      if (ms >= 300) sum += squared_length(unit.arm().plant().felt_n());
    }
    return std::sqrt(sum / (kMs - 300));
  }

  DeviceState state;
  std::function<void()> follows;
  int pulse_us = 0;
  bool keeps_raw = false;
  std::vector<std::array<std::int32_t, kLegs>> raw;
};

TEST(ArmOnVirtualArm, DriveBIsCalibratedFoundAndFelt) {
  Desk desk(firmware::Drive::Motor);
  desk.run_ms(400);
  ASSERT_EQ(desk.state.health, Health::Good);
  EXPECT_LT(distance(desk.state.position_mm, desk.truly()), 0.5);
  EXPECT_LT(length(desk.state.force_n), 0.2);  // its weight is carried
  DeviceCommand wall;
  wall.plane_count = 1;
  wall.planes[0] = {{0, 0, 1}, desk.state.position_mm.z - 2, 2.0, 0.004, 0};
  wall.limit_n = 4;
  const Vec3 below = desk.unit.arm().size().centre + Vec3{0, 0, -15};
  desk.unit.arm().plant().set_intent({below, {}});
  desk.run_ms(600, wall);
  // A hand of 0.2 N/mm that means to be 13 mm deep presses with some 2.4 N.
  EXPECT_NEAR(desk.state.force_n.z, 2.4, 0.5);
  EXPECT_GT(desk.state.position_mm.z, wall.planes[0].offset_mm - 1.7);
  desk.run_ms(400);
  EXPECT_LT(length(desk.state.force_n), 0.3);
  EXPECT_LT(desk.truly().z, wall.planes[0].offset_mm - 5);
  EXPECT_GT(desk.state.round_trip_us, 0);
}

TEST(ArmOnVirtualArm, DriveAIsCalibratedFoundAndFelt) {
  Desk desk(firmware::Drive::Stop);
  desk.run_ms(800);
  ASSERT_TRUE(is_usable(desk.state.health)) << in_words(desk.state.health);
  EXPECT_LT(distance(desk.state.position_mm, desk.truly()), 1.5);
  DeviceCommand wall;
  wall.plane_count = 1;
  wall.planes[0] = {{0, 0, 1}, desk.state.position_mm.z - 3, 2.0, 0, 0};
  wall.limit_n = 4;
  const Vec3 below = desk.unit.arm().size().centre + Vec3{0, 0, -15};
  for (int i = 0; i < 100; ++i) {
    desk.unit.arm().plant().set_intent({desk.unit.arm().size().centre + Vec3{0, 0, -0.15 * i}, {}});
    desk.run_ms(10, wall);
  }
  EXPECT_GT(desk.truly().z, wall.planes[0].offset_mm - 3);
  EXPECT_LT(desk.truly().z, wall.planes[0].offset_mm + 2);
  // Without the wall the hand is where it means to be.
  desk.unit.arm().plant().set_intent({below, {}});
  desk.run_ms(600);
  EXPECT_LT(desk.truly().z, wall.planes[0].offset_mm - 6);
}

TEST(ArmOnVirtualArm, DriveAIsCalibratedByAHandThatVisitsTheNotchesAndByItself) {
  Desk desk(firmware::Drive::Stop, false);
  virtual_arm::ArmPlant& plant = desk.unit.arm().plant();
  const arm::DeltaArm& size = desk.unit.arm().size();
  desk.run_ms(100);
  ASSERT_EQ(desk.state.health, Health::Uncalibrated);
  ArmCalibrator calibrator(firmware::Drive::Stop, 3);
  GuidedHand hand(firmware::Drive::Stop);
  desk.follows = [&] { hand.act(hand.step_for(calibrator.step()), desk.unit.arm()); };
  for (std::size_t step = 0; step < kLegs * kGaugeDeg.size(); ++step) {
    desk.run_ms(450);
    const double held = radians_from_degrees(kGaugeDeg[step % kGaugeDeg.size()]);
    ASSERT_NEAR(plant.angles()[step / kGaugeDeg.size()], held, 0.01);
    ASSERT_EQ(desk.measure(calibrator), std::nullopt) << step;
  }
  while (!calibrator.is_complete()) ASSERT_EQ(desk.measure(calibrator), std::nullopt);
  desk.follows = nullptr;
  const ArmCalibration made = desk.finish(calibrator);
  const ArmCalibration truth = desk.unit.calibration();
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    const ServoFit& fit = made.servos[leg];
    const ServoFit& best = truth.servos[leg];
    EXPECT_NEAR(fit.pulse_per_half_turn_us, best.pulse_per_half_turn_us, 40);
    // A microsecond is 0.18 degrees of this servo.
    EXPECT_NEAR(fit.pulse_at_zero_us, best.pulse_at_zero_us, 5);
    EXPECT_NEAR(degrees_from_radians(fit.gap_rad), degrees_from_radians(best.gap_rad), 0.6);
  }
  plant.set_hand(virtual_arm::kHandModels[1]);
  plant.set_intent({size.centre, {}});
  desk.run_ms(900);
  ASSERT_TRUE(is_usable(desk.state.health)) << in_words(desk.state.health);
  EXPECT_LT(distance(desk.state.position_mm, desk.truly()), 1.5);
  DeviceCommand wall;
  wall.plane_count = 1;
  wall.planes[0] = {{0, 0, 1}, desk.state.position_mm.z - 3, 2.0, 0, 0};
  wall.limit_n = 4;
  for (int i = 0; i < 100; ++i) {
    plant.set_intent({size.centre + Vec3{0, 0, -0.15 * i}, {}});
    desk.run_ms(10, wall);
  }
  EXPECT_GT(desk.truly().z, wall.planes[0].offset_mm - 3);
  EXPECT_LT(desk.truly().z, wall.planes[0].offset_mm + 2);
}

TEST(ArmOnVirtualArm, DriveBFindsItsWindingsAndIsEvenedOnceAHandHasLedItAbout) {
  Desk desk(firmware::Drive::Motor, false);
  const Vec3 centre = desk.unit.arm().size().centre;
  desk.run_ms(300);
  ArmCalibrator calibrator(firmware::Drive::Motor, 3);
  GuidedHand hand(firmware::Drive::Motor);
  desk.follows = [&] { hand.act(hand.step_for(calibrator.step()), desk.unit.arm()); };
  desk.run_ms(300);
  ASSERT_EQ(desk.measure(calibrator), std::nullopt);
  ASSERT_EQ(desk.measure(calibrator), std::nullopt);
  desk.pulse_us = 0;
  desk.run_ms(200);
  const auto led = desk.measure(calibrator);
  desk.follows = nullptr;
  ASSERT_EQ(led, std::nullopt);
  const ArmCalibration made = desk.finish(calibrator);
  for (std::size_t leg = 0; leg < kLegs; ++leg) {
    EXPECT_NEAR(made.cogging.amplitude_n_mm[leg], 15, 4);
  }
  desk.unit.arm().plant().set_intent({centre, {}});
  desk.run_ms(500);
  ASSERT_TRUE(is_usable(desk.state.health)) << in_words(desk.state.health);
  const double evened = desk.free_space_n();
  EXPECT_LE(evened, 0.15);
  ArmCalibration without = made;
  without.cogging = {};
  store(without, desk.folder.path());
  desk.device->open();
  desk.unit.arm().plant().set_intent({centre, {}});
  desk.run_ms(500);
  EXPECT_GT(desk.free_space_n(), 1.3 * evened) << "what it is for";
}

}  // namespace
}  // namespace carpus::devices
