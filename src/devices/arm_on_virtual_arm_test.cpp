// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The driver of our arm against the whole virtual arm: firmware, motors, mechanics, a hand. Virtual
// time.
#include <gtest/gtest.h>

#include "devices/arm_device.hpp"
#include "devices/fake_link_test_support.hpp"
#include "devices/virtual_unit.hpp"

namespace carpus::devices {
namespace {

class Desk {
 public:
  explicit Desk(firmware::Drive drive) : unit(drive, 3), line(std::make_shared<FakeLine>()) {
    store(unit.calibration(), folder.path());
    unit.arm().on_byte = [this](std::uint8_t byte, double) { line->to_host.push_back(byte); };
    unit.arm().plant().set_intent({unit.arm().size().centre, {}});
    device = std::make_unique<ArmDevice>(fake_opener(line), folder.path());
    device->open();
    for (const std::string& problem : device->problems()) ADD_FAILURE() << problem;
  }
  void run_ms(int ms, const DeviceCommand& wish = {}) {
    for (int i = 0; i < ms; ++i) {
      unit.arm().run_to_us(unit.arm().now_us() + 1000);
      const auto now = static_cast<Nanoseconds>(1e9 + unit.arm().now_us() * 1000);
      device->poll(now, state);
      device->command(now, wish);
      unit.arm().send(line->to_device);
      line->to_device.clear();
    }
  }
  [[nodiscard]] Vec3 truly() { return unit.arm().plant().tip() - unit.arm().size().centre; }

  TemporaryFolder folder;
  VirtualUnit unit;
  std::shared_ptr<FakeLine> line;
  std::unique_ptr<ArmDevice> device;
  DeviceState state;
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

}  // namespace
}  // namespace carpus::devices
