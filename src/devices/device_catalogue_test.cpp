// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/device_catalogue.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "core/error.hpp"
#include "devices/fake_link_test_support.hpp"
#include "devices/host_loop.hpp"
#include "devices/page_device.hpp"
#include "devices/simulated_port.hpp"

namespace carpus::devices {
namespace {

template <typename Is>
bool soon(Is is) {
  for (int i = 0; i < 600; ++i) {
    if (is()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST(DeviceCatalogue, FindsWhatIsThereAndNothingElse) {
  const TemporaryFolder folder;
  DeviceSearch search;
  search.device_folder = folder.path() / "dev";
  search.input_folder = folder.path() / "input";
  search.plugin_folder = folder.path() / "plugins";
  std::filesystem::create_directories(search.device_folder);
  std::filesystem::create_directories(search.plugin_folder);
  EXPECT_TRUE(find_devices(search).empty());
  std::ofstream(search.device_folder / "ttyACM0");
  std::ofstream(search.device_folder / "tty7");
  std::ofstream(search.plugin_folder / "touch.so");
  std::ofstream(search.plugin_folder / "notes.txt");
  std::filesystem::create_directories(search.device_folder / "ttyUSB_folder");
  const auto found = find_devices(search);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].id, "arm:" + (search.device_folder / "ttyACM0").string());
  EXPECT_EQ(found[1].id, "plugin:touch");
  for (const char* id : {"", "arm", "arm:", "plugin:../../x", "mouse"}) {
    EXPECT_THROW((void)make_device(id, search), InvalidInput) << id;
  }
}

TEST(DeviceCatalogue, ASimulatedArmIsFoundWorksAndIsUnplugged) {
  const TemporaryFolder folder;
  DeviceSearch search;
  search.serial_folders = {folder.path() / "simulated"};
  search.device_folder = search.input_folder = folder.path();
  search.calibrations = folder.path() / "calibrations";
  auto port = std::make_unique<SimulatedPort>(firmware::Drive::Motor, 7, search.serial_folders[0]);
  store(port->calibration(), search.calibrations);
  const auto found = find_devices(search);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].name, "Simulated arm arm_b_7");
  HostLoop loop(make_device(found[0].id, search));
  LoopState state;
  ASSERT_TRUE(soon([&] { return loop.look(state) && is_usable(state.device.health); }));
  EXPECT_EQ(state.device.unit, 7U);
  EXPECT_TRUE(state.able.force);
  EXPECT_LT(length(state.device.position_mm), 5);  // in its cradle
  port.reset();
  ASSERT_TRUE(soon([&] { return loop.look(state) && state.device.health == Health::Gone; }));
  EXPECT_TRUE(find_devices(search).empty());
  port = std::make_unique<SimulatedPort>(firmware::Drive::Motor, 7, search.serial_folders[0]);
  ASSERT_TRUE(soon([&] { return loop.look(state) && is_usable(state.device.health); }));
}

TEST(PageDevice, IsWellWhileItIsHeard) {
  PageDevice page;
  DeviceState state;
  page.heard({1, 2, 3}, 1'000'000'000);
  page.poll(1'000'000'000, state);
  EXPECT_EQ(state.health, Health::Good);
  EXPECT_EQ(state.position_mm, (Vec3{1, 2, 3}));
  page.poll(4'000'000'000, state);
  EXPECT_EQ(state.health, Health::Silent);
}

}  // namespace
}  // namespace carpus::devices
